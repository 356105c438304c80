#include "framework/meshing/made_by_root.hpp"

#include <stdexcept>
#include <string>

#include "framework/config/input_error.hpp"
#include "framework/parallel/gathered.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk {
namespace {

enum class Outcome { made, wrong_input, failed };

void share(std::string& text) {
  std::vector<char> letters(text.begin(), text.end());
  parallel::broadcast(letters);
  text.assign(letters.begin(), letters.end());
}

void share(std::vector<std::string>& texts) {
  std::size_t count = texts.size();
  parallel::broadcast(&count, sizeof count);
  texts.resize(count);
  for (std::string& text : texts) share(text);
}

void share(std::vector<Point>& points) {
  std::vector<double> numbers;
  for (const Point& point : points) numbers.insert(numbers.end(), point.begin(), point.end());
  parallel::broadcast(numbers);
  points.resize(numbers.size() / dimension);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = Eigen::Map<const Point>(&numbers[dimension * i]);
}

// One of the two is used: in a plane, or in space.
[[maybe_unused]] void share_places(RawMesh::Chain& chain) { parallel::broadcast(chain.nodes); }
[[maybe_unused]] void share_places(RawMesh::Surface& surface) { parallel::broadcast(surface.faces); }

void share(std::vector<RawMesh::Fracture>& fractures) {
  std::size_t count = fractures.size();
  parallel::broadcast(&count, sizeof count);
  fractures.resize(count);
  for (RawMesh::Fracture& fracture : fractures) {
    share(fracture.name);
    share_places(fracture);
  }
}

void share(RawMesh& mesh) {
  share(mesh.nodes);
  parallel::broadcast(mesh.cells);
  parallel::broadcast(mesh.regions);
  share(mesh.region_names);
  parallel::broadcast(mesh.boundary_faces);
  share(mesh.side_names);
  share(mesh.fractures);
}

}  // namespace

RawMesh made_by_root(const std::function<RawMesh()>& make) {
  if (parallel::size() == 1) return make();
  RawMesh mesh;
  Outcome outcome = Outcome::made;
  std::string message;
  if (parallel::is_root()) try {
      mesh = make();
    } catch (const InputError& error) {
      outcome = Outcome::wrong_input;
      message = error.what();
    } catch (const std::exception& error) {
      outcome = Outcome::failed;
      message = error.what();
    }
  parallel::broadcast(&outcome, sizeof outcome);
  if (outcome != Outcome::made) {
    share(message);
    if (outcome == Outcome::wrong_input) throw InputError(message);
    throw std::runtime_error(message);
  }
  share(mesh);
  return mesh;
}

}  // namespace sprekk
