#include "framework/assembly/property.hpp"

#include "framework/invariants.hpp"

namespace sprekk {

namespace {

template <class Evaluate>
Vector at_all(const std::vector<Place>& places, const Evaluate& evaluate) {
  Vector values(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) values[i] = evaluate(places[i]);
  return values;
}

}  // namespace

Property::Property(const Data& data, const std::vector<Place>& places, double start) : data_(data) {
  set(at_all(places, [&](Place place) {
    place.t = start;
    return data.at(place);
  }));
  if (data.depends_on_time()) places_ = places;
}

void Property::evaluate(const StepTime& step) {
  if (depends_on_time()) set(at_all(places_, [&](const Place& place) { return value_in_step(data_, place, step); }));
}

void Property::set(Vector values) {
  SPREKK_EXPECT(values_.size() == 0 || values.size() == values_.size(), values.size(), values_.size());
  SPREKK_EXPECT(is_finite(values), values.size());
  if (values.size() == values_.size() && values == values_) return;
  values_ = std::move(values);
  ++version_;
}

std::vector<Place> cell_places(const Mesh& mesh) {
  SPREKK_EXPECT(static_cast<int>(mesh.cell_region.size()) == mesh.cell_count(), mesh.cell_region.size());
  std::vector<Place> places;
  for (int c = 0; c < mesh.cell_count(); ++c) places.push_back({mesh.cell_center[c], mesh.cell_region[c], 0});
  return places;
}

Place fracture_cell_place(const Mesh& mesh, int i) {
  SPREKK_EXPECT(is_index(i, mesh.fracture_cell_count()), i, mesh.fracture_cell_count());
  const FractureCell& cell = mesh.fracture_cells[i];
  return {cell.center, mesh.cell_region[mesh.face_cells[cell.faces[0]][0]], 0, cell.fracture};
}

std::vector<Place> fracture_cell_places(const Mesh& mesh) {
  std::vector<Place> places;
  for (int i = 0; i < mesh.fracture_cell_count(); ++i) places.push_back(fracture_cell_place(mesh, i));
  return places;
}

}  // namespace sprekk
