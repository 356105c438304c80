#include "framework/linear/trilinos_module/multigrid.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <cmath>
#include <stdexcept>

#include "framework/linear/rigid_rotations.hpp"
#include "framework/linear/trilinos_module/tpetra_conversion.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
namespace {

using Teuchos::ParameterList;
using Teuchos::RCP;
using Teuchos::rcp;
using Places = Tpetra::MultiVector<double>;

std::vector<int> entities_of(const std::vector<int>& ids, const UnknownBlock& block) {
  std::vector<int> entities;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const int component = static_cast<int>(k) % block.components;
    if (component == 0) entities.push_back(ids[k] / block.components);
    if (ids[k] != entities.back() * block.components + component)
      throw std::invalid_argument("the components of entity " + std::to_string(ids[k] / block.components) + " of " +
                                  block.name + " are on different processes (a multigrid needs them on one)");
  }
  if (ids.size() % block.components != 0)
    throw std::invalid_argument("the components of the last entity of " + block.name + " are on different processes");
  return entities;
}

RCP<Places> make_coordinates(const std::vector<int>& entities, const UnknownBlock& block) {
  const int axes = static_cast<int>(block.coordinates.rows());
  const auto coordinates = rcp(new Places(tpetra::make_map(entities, block.entities), axes));
  for (int axis = 0; axis < axes; ++axis) {
    const Teuchos::ArrayRCP<double> data = coordinates->getDataNonConst(axis);
    for (std::size_t k = 0; k < entities.size(); ++k) data[k] = block.coordinates(axis, entities[k]);
  }
  return coordinates;
}

// Translations of every component, and for displacements the rotations about the block's centre.
RCP<tpetra::MultiVector> make_near_null_space(const std::vector<int>& entities, const UnknownBlock& block,
                                              const RCP<const tpetra::Map>& map) {
  const int translations = block.components, rotations = block.can_turn() ? rigid_rotations(block.components) : 0;
  const auto modes = rcp(new tpetra::MultiVector(map, translations + rotations));
  for (int c = 0; c < translations; ++c) {
    const Teuchos::ArrayRCP<double> data = modes->getDataNonConst(c);
    for (std::size_t k = 0; k < entities.size(); ++k) data[k * block.components + c] = 1;
  }
  if (rotations == 0) return modes;
  Coordinates centre = Coordinates::Zero(block.components);
  for (int entity = 0; entity < block.entities; ++entity) centre += block.coordinates.col(entity) / block.entities;
  const Coordinates low = block.coordinates.rowwise().minCoeff(), high = block.coordinates.rowwise().maxCoeff();
  const double extent = std::max((high - low).maxCoeff(), rounding::above_zero);
  for (int rotation = 0; rotation < rotations; ++rotation) {
    const Teuchos::ArrayRCP<double> data = modes->getDataNonConst(translations + rotation);
    for (std::size_t k = 0; k < entities.size(); ++k) {
      const Rotations motions = rotated((block.coordinates.col(entities[k]) - centre) / extent);
      for (int c = 0; c < translations; ++c) data[translations * k + c] = motions(c, rotation);
    }
  }
  return modes;
}

// Of a_ij^2 over a_ii a_jj: 164 iterations become 58 in case 3 of the benchmark in space; with 0.08 they are 54, in
// eight times the set-up.
constexpr double strong = 0.02;

// Whether some unknowns are strongly coupled, on any process. Where storage outweighs all exchange, as of a tracer that
// hardly diffuses in a short step, none are: MueLu would make a coarse level without unknowns, which cannot be
// factorized.
bool has_strong_couplings(const SparseMatrix& rows, const std::vector<int>& ids, const tpetra::Map& map) {
  Vector diagonal = Vector::Zero(rows.cols());  // of this process
  for (int row = 0; row < rows.rows(); ++row) diagonal[ids[row]] = std::abs(rows.coeff(row, ids[row]));
  int found = 0;
  for (int row = 0; row < rows.rows(); ++row)
    for (SparseMatrix::InnerIterator entry(rows, row); entry; ++entry) {
      const double of_column = diagonal[entry.col()];
      if (entry.col() != ids[row] && of_column > 0 &&
          entry.value() * entry.value() > strong * diagonal[ids[row]] * of_column)
        found = 1;
    }
  int anywhere = 0;
  Teuchos::reduceAll(*map.getComm(), Teuchos::REDUCE_MAX, found, Teuchos::outArg(anywhere));
  return anywhere > 0;
}

// Nothing but the smoother.
void set_one_level(ParameterList& list) {
  list.set("max levels", 1);
  list.set("coarse: type", "RELAXATION");
  list.sublist("coarse: params").set("relaxation: type", "Symmetric Gauss-Seidel");
  list.sublist("coarse: params").set("relaxation: sweeps", 2);
}

// Aggregates of what is strongly coupled follow fractures that conduct well. Prolongators are smoothed with the whole
// matrix: what is left of rows of multi-point fluxes without their small entries may have no positive diagonal.
void follow_strong_couplings(ParameterList& list) {
  list.set("aggregation: drop tol", strong);
  list.set("sa: use filtered matrix", false);
}

// On several processes the coarse levels move to fewer and the coarsest to one: Debian's Amesos2 KLU2, the coarse
// solver, is wrong on more than one.
void set_multigrid_levels(ParameterList& list, int unknowns, bool has_coordinates, bool is_parallel) {
  constexpr int rows_per_process = 3000;  // a level with fewer moves to fewer processes
  // The coarsest level is factorized; on several processes one of few unknowns is smoothed instead.
  constexpr int most_coarse = 1500, coarsening = 4, least_coarse = 50;
  const int coarsest = std::min(most_coarse, unknowns / coarsening);
  list.set("coarse: max size", coarsest);
  if (!is_parallel) return;
  if (!has_coordinates || coarsest < least_coarse) {
    list.set("coarse: type", "RELAXATION");
    ParameterList& relaxation = list.sublist("coarse: params");
    relaxation.set("relaxation: type", "Symmetric Gauss-Seidel");
    relaxation.set("relaxation: sweeps", 20);
    return;
  }
  list.set("repartition: enable", true);
  list.set("repartition: partitioner", "zoltan2");
  list.set("repartition: start level", 1);
  list.set("repartition: min rows per proc", rows_per_process);
  list.set("repartition: target rows per proc", rows_per_process);
  list.set("repartition: rebalance P and R", true);
  list.set("repartition: use subcommunicators", true);
  list.sublist("repartition: params").set("algorithm", "multijagged");
}

class MueLuMultigrid final : public Multigrid {
 public:
  MueLuMultigrid(const SparseMatrix& rows, const std::vector<int>& ids, const UnknownBlock& block) {
    const std::vector<int> entities = entities_of(ids, block);
    const int unknowns = static_cast<int>(rows.cols());
    const auto map = tpetra::make_map(ids, unknowns);
    const RCP<tpetra::Operator> matrix = tpetra::make_matrix(rows, map, map);

    ParameterList list;
    list.set("verbosity", "none");
    list.set("number of equations", block.components);
    list.set("multigrid algorithm", "sa");
    list.set("aggregation: type", "uncoupled");
    list.set("smoother: type", "RELAXATION");
    // With a stabilization the block stands for a Schur complement, whose small entries are not of this kind.
    const bool is_potential = block.kind == BlockKind::bulk_elliptic && block.stabilization.size() == 0;
    list.sublist("smoother: params").set("relaxation: type", is_potential ? "Gauss-Seidel" : "Symmetric Gauss-Seidel");
    if (is_potential) follow_strong_couplings(list);
    if (is_potential && !has_strong_couplings(rows, ids, *map))
      set_one_level(list);
    else
      set_multigrid_levels(list, unknowns, block.has_coordinates(), map->getComm()->getSize() > 1);
    ParameterList& user = list.sublist("user data");
    user.set("Nullspace", make_near_null_space(entities, block, map));
    if (block.has_coordinates()) user.set("Coordinates", make_coordinates(entities, block));
    cycle_ = MueLu::CreateTpetraPreconditioner(matrix, list);
  }

  void apply(const Vector& b, Vector& x) const override {
    const auto map = cycle_->getDomainMap();
    tpetra::MultiVector right(map, 1), left(map, 1);
    tpetra::copy(b, right);
    cycle_->apply(right, left);
    x = tpetra::view(left);
  }

 private:
  RCP<MueLu::TpetraOperator<double>> cycle_;
};

}  // namespace

std::unique_ptr<Multigrid> make_multigrid(const SparseMatrix& rows, const std::vector<int>& ids,
                                          const UnknownBlock& block) {
  return std::make_unique<MueLuMultigrid>(rows, ids, block);
}

}  // namespace sprekk
