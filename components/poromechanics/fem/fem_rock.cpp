#include "components/poromechanics/fem/fem_rock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "components/poromechanics/fem/face_functions.hpp"
#include "components/poromechanics/fem/volumetric_split.hpp"
#include "components/poromechanics/notes.hpp"
#include "components/poromechanics/stress_without_displacement.hpp"
#include "framework/field/ownership.hpp"
#include "framework/invariants.hpp"
#include "framework/mesh/cell_sums.hpp"
#include "framework/parallel/parallel.hpp"

namespace sprekk::poromechanics {

namespace {

/// One flag for each value at a location: whether this process owns it.
std::vector<char> owned_values(const Mesh& mesh, Location location, int entities, int components) {
  std::vector<char> owned;
  for (int i = 0; i < entities; ++i) owned.insert(owned.end(), components, is_owned(mesh, location, i));
  return owned;
}

}  // namespace

FemRock::FemRock(const ComponentContext& context, const FemOptions& options)
    : LoadedRock(context, options, Location::node),
      order_(options.order == "first" ? ElementOrder::first : ElementOrder::second) {
  edges_ = find_edges(mesh_, order_ == ElementOrder::second ? EdgesWithFunctions::all : EdgesWithFunctions::at_rims);
  held_ = held_directions(options_, mesh_, edges_);
  springs_ = springs_of_cells(options_, raw());
  if (edges_.count() > 0)
    of_edges_ = &context.fields.add(mesh_, {.owner = context.name,
                                            .name = "displacement_of_edges",
                                            .location = Location::listed,
                                            .components = dimension,
                                            .listed = edges_.count(),
                                            .role = Role::unknown(BlockKind::bulk_elastic),
                                            .unit = "m",
                                            .doc = "Displacement of middles of edges less the mean of their ends"});
  if (order_ == ElementOrder::second)
    of_faces_ = &context.fields.add(mesh_, {.owner = context.name,
                                            .name = "displacement_of_faces",
                                            .location = Location::face,
                                            .components = dimension,
                                            .role = Role::unknown(BlockKind::bulk_elastic),
                                            .unit = "m",
                                            .doc = "Displacement of middles of faces less the mean of their ends"});
  else if (stiffness_.changes() || split_volumetric(stiffness_.of_cells()).taken.maxCoeff() > 0)
    volumetric_ = &context.fields.add(mesh_, {.owner = context.name,
                                              .name = "volumetric_stress",
                                              .location = Location::cell,
                                              .role = Role::unknown(BlockKind::bulk_elliptic),
                                              .unit = "Pa",
                                              .doc = "Part of the stress against a change of volume, compression "
                                                     "positive"});
  add_wall_traction(context.fields);
  if (!young_) return;
  if (order_ == ElementOrder::first)
    throw InputError(origin_, "the Young's modulus of '" + name() + "' follows the state",
                     "elements of first order are stabilized by more than the stiffness of their cells, whose "
                     "derivatives are not known",
                     "write 'order: second'");
  young_->state().offer(
      "eps_v",
      {&volume_of_all_, Eigen::Map<const Vector>(mesh_.cell_measure.data(), mesh_.cell_count()).cwiseInverse()});
  take_initial_young();
}

NeedsDirectSolver::Need FemRock::needs_direct_solver() const {
  if (order_ == ElementOrder::first || !wall_traction_) return {};
  return {
      wall_traction_,
      "at second order jumps are differences of displacements alone, so where the rock is held nothing determines the "
      "tractions of walls"};
}

std::vector<Field*> FemRock::unknowns() const {
  std::vector<Field*> fields{&displacement_};
  if (of_edges_) fields.push_back(of_edges_);
  if (of_faces_) fields.push_back(of_faces_);
  if (volumetric_) fields.push_back(volumetric_);
  return fields;
}

void FemRock::discretize() {
  if (discretized_mesh_ == mesh_.version && discretized_stiffness_ == stiffness_.version()) return;
  discretized_mesh_ = mesh_.version;
  discretized_stiffness_ = stiffness_.version();
  ++discretizations_;
  operators_ = fem_operators(raw(), stiffness_.of_cells(), held_, order_, volumetric_ != nullptr, springs_);
  used_alpha_ = 0;
  momentum_.clear();
  int first = 0;
  for (const Field* field : unknowns()) {
    const LinearInFem& whole = operators_.momentum;
    const auto rows = [&](const SparseMatrix& matrix) { return SparseMatrix(matrix.middleRows(first, field->size())); };
    momentum_.push_back(
        quantity_of(LinearInFem{rows(whole.of_displacement), rows(whole.of_stress), rows(whole.of_traction),
                                rows(whole.of_force), rows(whole.of_given)},
                    owned_values(mesh_, field->spec().location, field->entities(), field->spec().components)));
    first += field->size();
  }
  std::vector<char> cells = owned_values(mesh_, Location::cell, mesh_.cell_count(), 1);
  for (int c = 0; c < mesh_.cell_count(); ++c) cells[c] = cells[c] && !stiffness_.excavation().is_removed(c);
  volume_ = quantity_of(operators_.volume, cells);
  if (young_) {
    const SparseMatrix whole = operators_.volume * operators_.all.of_displacement;
    volume_of_all_ = {Vector::Zero(mesh_.cell_count()), {}};
    int at = 0;
    for (const Field* field : unknowns()) {
      volume_of_all_.terms.push_back({field, Operator(SparseMatrix(whole.middleCols(at, field->size())))});
      at += field->size();
    }
  }
  if (wall_traction_)
    jump_ = quantity_of(operators_.jump,
                        owned_values(mesh_, Location::fracture_cell, mesh_.fracture_cell_count(), dimension));
}

void FemRock::evaluate_data(const StepTime& step) {
  if (!evaluate(step)) return;
  discretize();  // the body force acts on interior functions, too
  given_ = given_loads(options_, raw(), held_, operators_, stiffness_.excavation(),
                       settled_ ? &settled_->forces : nullptr, step);
  if (settled_) given_.displacements -= settled_->displacements;
}

FemRock::Quantity FemRock::quantity_of(LinearInFem operators, const std::vector<char>& owned) const {
  if (std::ranges::count(owned, 0) > 0)
    for (SparseMatrix* rows : {&operators.of_displacement, &operators.of_stress, &operators.of_traction,
                               &operators.of_force, &operators.of_given})
      *rows = keep_rows(*rows, owned);
  Quantity quantity{std::move(operators), {}};
  int first = 0;
  for (const Field* field : unknowns()) {
    quantity.value.terms.push_back(
        {field, Operator(SparseMatrix(quantity.operators.of_displacement.middleCols(first, field->size())))});
    first += field->size();
  }
  if (wall_traction_) quantity.value.terms.push_back({wall_traction_, Operator(quantity.operators.of_traction)});
  for (const PoreLoad& load : loads_) quantity.value.terms.push_back({load.pressure, {}});
  return quantity;
}

FemRock::Quantity FemRock::quantity_of(const SparseMatrix& of_all, const std::vector<char>& owned) const {
  const LinearInFem& all = operators_.all;
  return quantity_of(LinearInFem{of_all * all.of_displacement, of_all * all.of_stress, of_all * all.of_traction,
                                 of_all * all.of_force, of_all * all.of_given},
                     owned);
}

std::vector<FemRock::Quantity*> FemRock::quantities() {
  std::vector<Quantity*> all{&volume_};
  if (wall_traction_) all.push_back(&jump_);
  for (Quantity& rows : momentum_) all.push_back(&rows);
  return all;
}

void FemRock::use_loads() {
  if (used_alpha_ == alpha_version()) return;
  used_alpha_ = alpha_version();
  loads_applied_ = false;
  for (Quantity* quantity : quantities()) {
    const std::size_t first = quantity->value.terms.size() - loads_.size();
    for (std::size_t i = 0; i < loads_.size(); ++i)
      quantity->value.terms[first + i].matrix =
          Operator(SparseMatrix(quantity->operators.of_stress * loads_[i].present_alpha().asDiagonal()));
  }
}

void FemRock::use_given() {
  if (loads_applied_) return;
  loads_applied_ = true;
  for (Quantity* quantity : quantities()) {
    const LinearInFem& operators = quantity->operators;
    quantity->value.constant = operators.of_force * given_.forces + operators.of_given * given_.displacements;
    for (const PoreLoad& load : loads_)
      quantity->value.constant -= operators.of_stress * load.present_alpha().cwiseProduct(load.reference);
  }
  add_jumps(jump_.value.constant);
}

void FemRock::require_countable() const {
  if (order_ == ElementOrder::first)
    throw InputError(origin_, "the displacements of '" + name() + "' cannot be counted from a settled state",
                     "elements of first order are stabilized by more than the stress of their cells",
                     dimension == 2 ? "use 'order: second', or poromechanics/mpsa" : "use 'order: second'");
}

void FemRock::count_from_equilibrium() {
  keep_settled(
      settled_forces(options_, raw(), present_stiffness(), operators_, springs_, coefficients(), pore_stress()),
      given_.displacements);
  for (Field* field : unknowns()) field->set_both(Vector::Zero(field->size()));
}

void FemRock::begin_step(const StepTime& step) {
  evaluate_data(step);
  const long before = discretizations_;
  discretize();
  const bool is_other_modulus = young_ && take_young();
  if (is_other_modulus) used_alpha_ = 0;
  use_loads();
  use_given();
  if (is_other_modulus || (young_ && discretizations_ > before)) use_young();
}

void FemRock::assemble(Assembly& assembly, const StepTime&) const {
  const std::vector<Field*> fields = unknowns();
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (assembly.has_row(*fields[i])) {
      SPREKK_EXPECT(i < momentum_.size(), name());
      assembly.linear(*fields[i], momentum_[i].value);
    }
  if (young_ && assembly.wants_derivatives()) assemble_young(assembly);
}

Vector FemRock::coefficients() const {
  const LinearInFem& all = operators_.all;
  Vector unknown(all.of_displacement.cols());
  int first = 0;
  for (const Field* field : unknowns()) {
    unknown.segment(first, field->size()) = field->now();
    first += field->size();
  }
  Vector values = all.of_displacement * unknown + all.of_force * given_.forces + all.of_given * given_.displacements;
  if (wall_traction_) values += all.of_traction * wall_traction_->now();
  for (const PoreLoad& load : loads_) values += all.of_stress * load.stress();
  return values;
}

Vector FemRock::mean_stress() const {
  const std::vector<Field*> fields = unknowns();
  const bool is_at_rest = std::ranges::all_of(fields, [](const Field* field) { return field->now().isZero(0); });
  if (discretizations_ == 0 || (!settled_ && is_at_rest))
    return stress_without_displacement(mesh_, options_, pore_stress());
  const Vector all = coefficients(), of_pores = pore_stress();
  const std::vector<Stiffness> stiffness = present_stiffness();
  Vector stress(symmetric_components * mesh_.cell_count());
  for (int c = 0; c < mesh_.cell_count(); ++c) {
    SymmetricTensor of_cell = stiffness[c] * strain_of(mean_gradient(raw(), operators_.tips, all, c));
    of_cell += of_pores[c] * isotropic_components();
    const double support = stiffness_.excavation().support(c);
    if (settled_)
      of_cell += support * settled_->stress.segment<symmetric_components>(symmetric_components * c);
    else if (!options_.initial_stress.is_zero())
      of_cell += support * options_.initial_stress_at({mesh_.cell_center[c], mesh_.cell_region[c], 0});
    stress.segment<symmetric_components>(symmetric_components * c) = of_cell;
  }
  return stress;
}

std::string FemRock::flaw_of_jumps() const {
  if (order_ == ElementOrder::second) return {};
  return "elements of first order are linear beside the cells at tips: factors from the jumps there are 2 to 4 % too "
         "small on each mesh";
}

Vector FemRock::outer_displacement() const {
  const Vector all = coefficients();
  Vector outer(dimension * mesh_.face_count());
  for (int f = 0; f < mesh_.face_count(); ++f) {
    outer.segment<dimension>(dimension * f) = displacement_of_middle(raw(), operators_.tips, all, f);
  }
  return outer;
}

void FemRock::note_step(Notes& notes, const StepTime&) const {
  const Vector all = coefficients();
  LargestStrain largest;
  for (int c = 0; c < mesh_.cell_count(); ++c)
    if (const double strain = mean_gradient(raw(), operators_.tips, all, c).norm();
        strain > largest.strain && !stiffness_.excavation().is_removed(c))
      largest = {strain, mesh_.cell_center[c]};
  note_large_strain(notes, name(), largest, options_, stiffness_.of_cells());
}

}  // namespace sprekk::poromechanics
