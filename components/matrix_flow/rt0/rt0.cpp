#include "components/matrix_flow/rt0/rt0.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <stdexcept>

#include "components/matrix_flow/check_conditions.hpp"
#include "components/matrix_flow/rt0/flux_mass.hpp"
#include "components/matrix_flow/rt0/tip_terms.hpp"
#include "framework/discretization/changes_along_face.hpp"
#include "framework/invariants.hpp"

namespace sprekk::matrix_flow {
namespace {

FluxMass inverse_of(const FluxMass& mass) {
  // In a plane masses are symmetric, in space those of cells with bent faces are not.
  if constexpr (dimension == 2)
    return Eigen::LLT<FluxMass>(mass).solve(FluxMass::Identity(mass.rows(), mass.cols()));
  else
    return mass.inverse();
}

/// The entries of all matrices, cell by cell.
class Entries {
 public:
  Entries(const Mesh& mesh, const std::vector<FlowCondition>& conditions) : mesh_(mesh), conditions_(conditions) {}

  /// Adds the fluxes of a cell, F = M^-1 (p − h), without those that are prescribed: with `free` the other faces,
  /// F_free = M_ff^-1 (p − h_free − M_fq q).
  /// `tip`: null away from tips; it adds `missing` · amounts to p − h.
  void add(int cell, const FluxMass& mass, const TipTerm* tip) {
    std::vector<int> free, given;
    const CellFaces& faces = mesh_.cell_faces[cell];
    for (int k = 0; k < faces.size(); ++k) (conditions_[faces[k]] == FlowCondition::flux ? given : free).push_back(k);
    const FluxMass coupling = mass(free, given);
    FluxMass conductance(free.size(), free.size());
    if (!free.empty()) {
      conductance = inverse_of(mass(free, free));
    }
    const FluxMass of_given = conductance * coupling;  // less of it flows through the free faces
    TipTerm of_tip = tip ? *tip : TipTerm{};
    if (tip) of_tip.missing = conductance * tip->missing(free, Eigen::all);

    for (std::size_t i = 0; i < free.size(); ++i) {
      const int face = faces[free[i]];
      const bool is_inner = conditions_[face] == FlowCondition::none;
      // The flux out of the first cell of the face; and minus the sum of what leaves both cells.
      const double share = is_inner ? (mesh_.face_cells[face][0] == cell ? 0.5 : -0.5) : 1;
      const Row flux{flux_cell, flux_face, flux_boundary, face, share};
      add_flux(flux, cell, faces, free, given, conductance.row(i), of_given.row(i));
      if (tip) add_modes(flux.cells, face, *tip->flow, share * of_tip.missing.row(i));
      if (is_inner) {
        const Row sum{continuity_cell, continuity_face, continuity_boundary, face, -1};
        add_flux(sum, cell, faces, free, given, conductance.row(i), of_given.row(i));
        if (tip) add_modes(sum.cells, face, *tip->flow, -of_tip.missing.row(i));
      } else {
        const double scale = 1 / mass(free[i], free[i]);
        trace_boundary.emplace_back(face, face, 1);
        continuity_face.emplace_back(face, face, scale);
        continuity_boundary.emplace_back(face, face, -scale);
      }
    }
    for (const int k : given) {
      add_given(cell, mass, k, free, given, conductance, of_given);
      if (!tip) continue;
      const TipFlow::Modes modes = tip->missing.row(k) - mass.row(k)(Eigen::all, free) * of_tip.missing;
      add_modes(trace_cell, faces[k], *tip->flow, modes);
      add_modes(continuity_cell, faces[k], *tip->flow, -modes / mass(k, k));
    }
  }

  std::vector<Triplet> flux_cell, flux_face, flux_boundary, trace_cell, trace_face, trace_boundary;
  std::vector<Triplet> continuity_cell, continuity_face, continuity_boundary;

 private:
  /// A row of three matrices to which a flux is added, times `factor`.
  struct Row {
    std::vector<Triplet>&cells, &faces, &boundary;
    int row;
    double factor;
  };
  using Coefficients = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, most_faces>;

  /// conductance · (p − h) − of_given · q.
  void add_flux(const Row& to, int cell, const CellFaces& faces, const std::vector<int>& free,
                const std::vector<int>& given, const Coefficients& conductance, const Coefficients& of_given) const {
    to.cells.emplace_back(to.row, cell, to.factor * conductance.sum());
    for (std::size_t j = 0; j < free.size(); ++j) {
      const int face = faces[free[j]];
      (conditions_[face] == FlowCondition::none ? to.faces : to.boundary)
          .emplace_back(to.row, face, -to.factor * conductance[j]);
    }
    for (std::size_t j = 0; j < given.size(); ++j)
      to.boundary.emplace_back(to.row, faces[given[j]], -to.factor * of_given[j]);
  }

  static void add_modes(std::vector<Triplet>& to, int row, const TipFlow& flow, const TipFlow::Modes& modes) {
    for (std::size_t i = 0; i < flow.cells().size(); ++i)
      to.emplace_back(row, flow.cells()[i], modes.dot(flow.share().col(i)));
  }

  /// The flux through a face where it is prescribed, and the pressure there: p − h = M_qf F_free + M_qq q.
  void add_given(int cell, const FluxMass& mass, int k, const std::vector<int>& free, const std::vector<int>& given,
                 const FluxMass& conductance, const FluxMass& of_given) {
    const CellFaces& faces = mesh_.cell_faces[cell];
    const int face = faces[k];
    const double scale = 1 / mass(k, k);
    flux_boundary.emplace_back(face, face, 1);
    continuity_face.emplace_back(face, face, scale);
    const auto add_term = [&](int column, double value, std::vector<Triplet>& trace, std::vector<Triplet>& equation) {
      trace.emplace_back(face, column, value);
      equation.emplace_back(face, column, -scale * value);
    };
    const Coefficients by_free = mass.row(k)(Eigen::all, free);
    const Coefficients shares = by_free * conductance;
    add_term(cell, 1 - shares.sum(), trace_cell, continuity_cell);
    for (std::size_t j = 0; j < free.size(); ++j) {
      const int other = faces[free[j]];
      if (conditions_[other] == FlowCondition::none) {
        add_term(other, shares[j], trace_face, continuity_face);
      } else {
        add_term(other, shares[j], trace_boundary, continuity_boundary);
      }
    }
    const Coefficients resistances = mass.row(k)(Eigen::all, given) - by_free * of_given;
    for (std::size_t j = 0; j < given.size(); ++j)
      add_term(faces[given[j]], -resistances[j], trace_boundary, continuity_boundary);
  }

  const Mesh& mesh_;
  const std::vector<FlowCondition>& conditions_;
};

void check_mobility(const std::vector<Tensor>& mobility) {
  for (std::size_t cell = 0; cell < mobility.size(); ++cell)
    if (!(mobility[cell].trace() > 0 && mobility[cell].determinant() > 0))
      throw std::runtime_error("flux discretization: the mobility of cell " + std::to_string(cell) +
                               " is not positive definite");
}

FluxOperators operators_of(const Mesh& mesh, const Entries& entries) {
  const auto matrix = [&](const std::vector<Triplet>& from, int columns) {
    SparseMatrix made(mesh.face_count(), columns);
    made.setFromTriplets(from.begin(), from.end());
    return made;
  };
  const int cells = mesh.cell_count(), faces = mesh.face_count();
  return {matrix(entries.flux_cell, cells),
          matrix(entries.flux_boundary, faces),
          matrix({}, directions_of_faces * faces),
          matrix(entries.trace_cell, cells),
          matrix(entries.trace_boundary, faces),
          matrix({}, directions_of_faces * faces),
          matrix({}, faces),
          {matrix(entries.flux_face, faces), matrix(entries.trace_face, faces), matrix(entries.continuity_cell, cells),
           matrix(entries.continuity_face, faces), matrix(entries.continuity_boundary, faces)}};
}

}  // namespace

FluxOperators discretize_rt0(const Mesh& mesh, const std::vector<Tensor>& mobility,
                             const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  check_conditions(mesh, mobility, conditions, nodes);
  return discretize_rt0_for_short_steps(mesh, mobility, conditions, std::vector<double>(mesh.cell_count(), 0));
}

FluxOperators discretize_rt0_for_short_steps(const Mesh& mesh, const std::vector<Tensor>& mobility,
                                             const std::vector<FlowCondition>& conditions,
                                             const std::vector<double>& shares) {
  check_conditions(mesh, mobility, conditions, {});
  check_mobility(mobility);
  SPREKK_EXPECT(static_cast<int>(shares.size()) == mesh.cell_count(), shares.size(), mesh.cell_count());
  std::vector<FluxMass> masses;
  for (int cell = 0; cell < mesh.cell_count(); ++cell) {
    masses.push_back(flux_mass(mesh, cell, mobility[cell]));
    if (shares[cell] > 0) masses.back() += shares[cell] * mass_for_short_steps(mesh, cell, mobility[cell]).added;
  }
  const TipTerms tips(mesh, mobility, conditions, masses);
  Entries entries(mesh, conditions);
  for (int cell = 0; cell < mesh.cell_count(); ++cell) entries.add(cell, masses[cell], tips.of(cell));
  return operators_of(mesh, entries);
}

FluxOperators discretize_lumped_rt0(const Mesh& mesh, const std::vector<Tensor>& mobility,
                                    const std::vector<FlowCondition>& conditions, const std::vector<char>& nodes) {
  check_conditions(mesh, mobility, conditions, nodes);
  check_mobility(mobility);
  Entries entries(mesh, conditions);
  for (int cell = 0; cell < mesh.cell_count(); ++cell)
    entries.add(cell, lumped_flux_mass(mesh, cell, mobility[cell]).mass, nullptr);
  return operators_of(mesh, entries);
}

}  // namespace sprekk::matrix_flow
