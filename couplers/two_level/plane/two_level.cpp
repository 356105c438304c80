// two_level: gives tips the coarse level's state around them (Eqs. 15-19 of the paper), and takes their paths over.
#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "components/capabilities/fracture_fluid.hpp"
#include "components/capabilities/fracture_tips.hpp"
#include "components/capabilities/matrix_fluid.hpp"
#include "components/capabilities/poroelastic_rock.hpp"
#include "couplers/contacts.hpp"
#include "couplers/two_level/plane/along_fracture.hpp"
#include "couplers/two_level/plane/nodal_values.hpp"
#include "couplers/two_level/plane/pressure_near_tips.hpp"
#include "framework/assembly/follows_mesh.hpp"
#include "framework/assert.hpp"
#include "framework/field/ownership.hpp"
#include "framework/scene/registry.hpp"

namespace sprekk::couplers {
namespace {

struct TwoLevelOptions {
  std::string reconstruction = "wall_traction";
  std::string pore_pressure = "near_tips";
  std::optional<double> propagation_threshold;
  Spec spec() {
    Spec spec("two_level",
              "Between the coarse level and the tips of fractures: boundary data for the fine level (the paper's Eqs. "
              "15-19), and "
              "its paths for the coarse level (the paper's sec. 4.4.2). Between the rock, the tips, and the fluid in "
              "the fractures, "
              "whose pressure the walls carry that grow on the fine level (without it they carry none). With the "
              "contact, the "
              "walls of a fracture that has kinked slide and part on the fine level, too, by the law of their cells.");
    spec.ignore("type").ignore("between");
    spec.choice(
        "reconstruction", reconstruction,
        {{"wall_traction", "walls are loaded by the tractions of the coarse level, which are smooth at tips"},
         {"wall_jump", "walls have the displacement jump of the coarse level (the paper's Eq. 15)"},
         {"cell_centred",
          "the same with jumps and displacements between cell centres, where strain counts as slip: for "
          "comparison with the paper's scripts only"}},
        {.doc = "What the walls of the fine level take from the coarse one.", .source = "the paper's sec. 4.4.1"});
    spec.choice(
        "pore_pressure", pore_pressure,
        {{"near_tips",
          "where fluid passes the walls, the pressure beside tips goes with the square root of the distance, and has "
          "the means of the cells: the least integral of its squared gradient, with the pressures at the walls; "
          "elsewhere as fitted"},
         {"fitted",
          "linear functions are fitted to the cells; near tips that exchange fluid with the rock they are too smooth"}},
        {.doc = "How the pore pressure that loads the fine level follows from the cells. With near_tips factors of "
                "open fractures are two to ten times as accurate shortly after an injection has begun."});
    spec.quantity("propagation_threshold", propagation_threshold,
                  {.range = positive(),
                   .doc = "The part of the coarse mesh size at which a path is handed to the coarse level; by default "
                          "0.25 with growth within steps, otherwise 0.5.",
                   .source = "epsilon_p of the paper's sec. 4.4.2"});
    return spec;
  }
};

class TwoLevel : public Coupler, public FollowsMesh, public TipSurroundings {
 public:
  TwoLevel(const CouplerContext& context, const TwoLevelOptions& options)
      : Coupler(context.name),
        mesh_(context.mesh),
        options_(options),
        rock_(context.the<RockState>()),
        walls_(context.the<RockWalls>()),
        fluid_(context.find<FractureFluid>()),
        fluid_left_out_(fluid_ ? "" : context.left_out<FractureFluid>()),
        contacts_(context),
        moving_(context.find<MovingTips>()),
        location_(mesh_),
        displacement_(mesh_, is_cell_centred() ? NodalValues::From::mean_of_cells : NodalValues::From::cells_and_faces),
        pore_stress_(mesh_, NodalValues::From::cells) {
    if (is_cell_centred() && is_nodal())
      throw InputError(context.origin, "coupler " + name() + " cannot take displacements between cell centres",
                       "those of the rock are displacements of nodes", "choose another 'reconstruction'");
    if (!rock_.stiffness(0))
      throw InputError(context.origin, "coupler " + name() + " cannot give the stiffness around tips",
                       "stress intensity factors are those of an isotropic rock; this one is anisotropic",
                       "give the rock a young_modulus and a poisson_ratio, or remove the tips");
    if (const auto* whole = dynamic_cast<const PoroelasticRock*>(&rock_); whole && whole->stiffness_follows_state())
      throw InputError(context.origin, "coupler " + name() + " cannot give the stiffness around tips",
                       "the Young's modulus of the rock follows the state, and stress intensity factors are those of a "
                       "rock with one modulus",
                       "give a young_modulus that does not depend on the state, or remove the tips");
    for (int i = 0; i < static_cast<int>(mesh_.fractures.size()); ++i) along_.emplace_back(mesh_, i);
    context.the<FractureTips>().accept_surroundings(*this);
  }

  void begin_step(const StepTime&) override {}
  void assemble(Assembly&, const StepTime&) const override {}

  void note_input(Notes& notes) const override {
    if (fluid_left_out_.empty()) return;
    notes.add(
        name() + " without " + fluid_left_out_,
        fmt::format("walls that grow on the fine level carry no fluid pressure ({} is not in the `between` of the "
                    "coupler {}) add it there, unless that is meant",
                    fluid_left_out_, name()));
  }

  /// Adds a note on tips that are too fast for the mesh to resolve leak-off. At a tip with the speed V leak-off reaches
  /// about c/V from the walls (c: diffusivity); if cells are longer, the leak-off next to the tip is that of a whole
  /// cell, and too small.
  void note_step(Notes& notes, const StepTime&) const override {
    const MatrixFluid* rock_fluid = fluid_ ? fluid_->rock_fluid() : nullptr;
    if (!moving_ || !rock_fluid) return;
    for (const MovingTips::Tip& tip : moving_->moving_tips()) {
      const Fracture& fracture = mesh_.fractures[tip.fracture];
      const FractureCell& last =
          mesh_.fracture_cells[tip.at_end ? fracture.first_cell + fracture.cell_count - 1 : fracture.first_cell];
      const int cell = mesh_.face_cells[last.faces[0]][0];
      const double diffusivity = rock_fluid->diffusivity(cell), reach = diffusivity / tip.speed;
      // The extent of the cell normal to the wall.
      const double size = mesh_.cell_measure[cell] / last.measure;
      if (!(reach < size)) continue;
      notes.add(name() + ": fracture " + fracture.name + " outruns its leak-off",
                fmt::format("a tip of '{}' moves at {:.3g} m/s, and the fluid of the rock with the diffusivity {:.3g} "
                            "m^2/s: leak-off "
                            "behind the tip reaches {:.3g} m into cells of {:.3g} m (it is not resolved there, and the "
                            "fracture may become too "
                            "long) make cells beside the path shorter, or compare with a run in which they are",
                            fracture.name, tip.speed, diffusivity, reach, size),
                size / reach);
    }
  }

  void update() override {
    if (updated_for_ == version()) return;
    updated_for_ = version();
    if (is_nodal())
      displacement_.set_nodes(dimension, rock_.displacement().now());
    else
      displacement_.set(dimension, rock_.displacement().now(), rock_.outer_displacement());
    update_pore_stress();
    traction_ = walls_.wall_traction().now();
    jump_ = is_cell_centred() ? jump_between_cells() : walls_.displacement_jump().now();
    exchange(mesh_, Location::fracture_cell, 2, jump_);
    if (!contacts_.empty()) fluid_traction_ = traction_ - contacts_.traction();
  }

  /// The pressure near tips, which moves into new cells with the shape that loads the fine level.
  void add_known_within_cells(const Field& field, KnownWithinCells& known) const override {
    if (options_.pore_pressure != "near_tips" || &field != pressure_by_exchange()) return;
    const LinearExpression& at_walls = fluid_->rock_walls()->wall_pressure();
    if (at_walls.constant.size() == 0) return;  // no step has begun
    // Trials of a step ask for the same accepted state on the same mesh, which is solved once.
    if (!accepted_fit_) accepted_fit_.emplace(mesh_, NodalValues::From::cells);
    if (!accepted_near_tips_) accepted_near_tips_.emplace(mesh_);
    accepted_fit_->set(1, field.accepted(), {});
    accepted_near_tips_->set({field.accepted(), pressures_at_walls(at_walls.accepted()), accepted_fit_->of_nodes(0)});
    accepted_near_tips_->add_pieces(known.pieces);
  }

  std::uint64_t version() const override {
    return rock_.properties_version() + rock_.displacement().version() + walls_.wall_traction().version() +
           (fluid_ ? fluid_->pressure().version() : 0) + contacts_.traction_version();
  }

  int region(const Point& x) const override { return mesh_.cell_region[cell_at(x)]; }

  LameParameters stiffness(const Point& x) const override {
    const auto stiffness = rock_.stiffness(cell_at(x));
    if (!stiffness)
      throw std::runtime_error("the fine level of fracture tips needs an isotropic rock; it is anisotropic here");
    return *stiffness;
  }

  std::uint64_t stiffness_by_place() const override {
    const std::uint64_t version = rock_.properties_version() + 1;
    if (version != compared_for_) {
      compared_for_ = version;
      const auto first = rock_.stiffness(0);
      is_uniform_ = true;
      for (int cell = 1; cell < mesh_.cell_count() && is_uniform_; ++cell) {
        const auto other = rock_.stiffness(cell);
        // Anisotropic rock is refused where its stiffness is asked for.
        is_uniform_ = !first || !other || (first->lambda == other->lambda && first->shear == other->shear);
      }
    }
    return is_uniform_ ? 0 : version;
  }

  const std::vector<Border>& stiffness_borders() const override {
    const std::uint64_t version = rock_.properties_version() + 1;
    if (version == borders_for_) return stiffness_borders_;
    borders_for_ = version;
    stiffness_borders_.clear();
    for (int face = 0; face < mesh_.face_count(); ++face) {
      const auto [cell, other] = mesh_.face_cells[face];
      if (other == none) continue;
      const auto one = rock_.stiffness(cell), two = rock_.stiffness(other);
      if (!one || !two || (one->lambda == two->lambda && one->shear == two->shear)) continue;
      Border& border = stiffness_borders_.emplace_back();
      for (int k = 0; k < dimension; ++k) border[k] = mesh_.nodes[mesh_.face_nodes[face][k]];
    }
    return stiffness_borders_;
  }

  Point displacement(const Point& x, const Point& inside) const override {
    return displacement_.at<dimension>(cell_at(inside), x);
  }

  StressOffsets stress_offsets(const std::vector<Point>& places, const std::vector<Point>& pores) const override {
    SPREKK_EXPECT(places.size() == pores.size(), places.size(), pores.size());
    std::vector<NodalValues::Place> found;
    found.reserve(places.size());
    std::vector<int> cells;
    std::vector<std::pair<std::size_t, PressureNearTips::Place>> near;
    for (std::size_t i = 0; i < places.size(); ++i) {
      cells.push_back(cell_at(places[i]));
      const int cell = pores[i] == places[i] ? cells.back() : cell_at(pores[i]);
      found.push_back(pore_stress_.place(cell, pores[i]));
      if (!near_tips_) continue;
      if (const auto place = near_tips_->place(cell, pores[i])) near.emplace_back(i, *place);
    }
    const auto initial_stress = [this, places, cells = std::move(cells)] {
      Eigen::Matrix<double, symmetric_components, Eigen::Dynamic> initial(symmetric_components, places.size());
      for (std::size_t i = 0; i < places.size(); ++i) initial.col(i) = rock_.initial_stress(cells[i], places[i]);
      return initial;
    };
    return [this, found = std::move(found), near_tips = std::move(near), initial = initial_stress(), initial_stress] {
      auto offsets = rock_.initial_stress_changes() ? initial_stress() : initial;
      for (std::size_t i = 0; i < found.size(); ++i)
        offsets.col(i).head<dimension>().array() += pore_stress_.at<pore_values>(found[i])[of_stress];
      for (const auto& [i, place] : near_tips) {
        const auto fitted = pore_stress_.at<pore_values>(found[i]);
        const PressureNearTips::Value near = near_tips_->at(place);
        offsets.col(i).head<dimension>().array() +=
            fitted[of_stress_by_pressure] * near.weight * (near.value - fitted[of_pressure]);
      }
      return offsets;
    };
  }

  BodyForces body_forces(const std::vector<Point>& places) const override {
    if (!rock_.has_body_force()) return {};
    std::vector<int> cells;
    for (const Point& x : places) cells.push_back(cell_at(x));
    return [this, places, cells = std::move(cells)] {
      Eigen::Matrix<double, dimension, Eigen::Dynamic> forces(dimension, places.size());
      for (std::size_t i = 0; i < places.size(); ++i) forces.col(i) = rock_.body_force(cells[i], places[i]);
      return forces;
    };
  }

  bool gives_jumps() const override { return options_.reconstruction != "wall_traction"; }
  Point wall_traction(int fracture, double s) const override { return along_[fracture].at(s, traction_); }
  std::optional<Sliding> sliding(int fracture, double s) const override {
    const int index = along_[fracture].index_at(s);
    const FractureContact* contact = contacts_.at(index);
    if (!contact) return std::nullopt;
    const FractureCell& cell = mesh_.fracture_cells[index];
    const std::optional<SlidingWalls> law = cell.grown ? std::nullopt : contact->sliding(index);
    if (!law) return std::nullopt;
    return Sliding{along_[fracture].at(s, fluid_traction_), cell.to_global({1, -law->direction * law->friction}),
                   cell.to_global({1, -law->dilation}), law->opening};
  }
  Point wall_jump(int fracture, double s) const override { return along_[fracture].jump(s, jump_); }
  std::string flaw_of_jumps() const override {
    return is_cell_centred() ? "those between cell centres count strain as slip" : walls_.flaw_of_jumps();
  }

  double fluid_pressure(int fracture, bool at_end) const override {
    return fluid_ ? fluid_->pressure().now()[end_cell(fracture, at_end)] : 0;
  }
  double accepted_fluid_pressure(int fracture, bool at_end) const override {
    return fluid_ ? fluid_->pressure().accepted()[end_cell(fracture, at_end)] : 0;
  }
  double fluid_viscosity(int fracture, bool at_end) const override {
    return fluid_ ? fluid_->viscosity_between_walls(end_cell(fracture, at_end)) : 0;
  }
  double filled_part(int fracture, bool at_end) const override {
    return fluid_ ? fluid_->filled_part(end_cell(fracture, at_end)) : 1;
  }
  double jump_at_tip(int fracture, bool at_end) const override {
    return jump_.segment<dimension>(dimension * end_cell(fracture, at_end)).norm();
  }
  std::optional<double> propagation_threshold() const override { return options_.propagation_threshold; }

 private:
  /// The values that are fitted to cells: the stress by the pore pressure, the pressure, and the derivative of the one
  /// by the other.
  enum PoreValue { of_stress, of_pressure, of_stress_by_pressure, pore_values };

  /// The pressure of a fluid that passes the walls and loads the rock, or nullptr.
  const Field* pressure_by_exchange() const {
    MatrixFluid* fluid = fluid_ ? fluid_->rock_fluid() : nullptr;
    return fluid && rock_.pore_stress_by(fluid->pressure()).size() > 0 ? &fluid->pressure() : nullptr;
  }

  /// Where a fluid passes the walls, its pressure near tips is more than the fit to cells.
  void update_pore_stress() {
    const Vector stress = rock_.pore_stress();
    Vector values = Vector::Zero(pore_values * stress.size());
    values(Eigen::seqN(+of_stress, stress.size(), +pore_values)) = stress;
    const Field* field = options_.pore_pressure == "near_tips" ? pressure_by_exchange() : nullptr;
    if (!field) {
      pore_stress_.set(+pore_values, values, {});
      return;
    }
    const Vector& pressure = field->now();
    values(Eigen::seqN(+of_pressure, stress.size(), +pore_values)) = pressure;
    values(Eigen::seqN(+of_stress_by_pressure, stress.size(), +pore_values)) = rock_.pore_stress_by(*field);
    pore_stress_.set(+pore_values, values, {});
    if (!near_tips_) near_tips_.emplace(mesh_);
    near_tips_->set({pressure, pressures_at_walls(fluid_->rock_walls()->wall_pressure().now()),
                     pore_stress_.of_nodes(of_pressure)});
  }

  /// Where walls let fluid through.
  std::vector<std::optional<double>> pressures_at_walls(Vector all) const {
    exchange(mesh_, Location::wall, 1, all);
    const Vector permeability = fluid_->normal_permeability().value;
    std::vector<std::optional<double>> pressures;
    for (int wall = 0; wall < mesh_.wall_count(); ++wall)
      pressures.push_back(permeability[wall] > 0 && fluid_->rock_walls()->is_behind_wall(wall)
                              ? std::optional(all[wall])
                              : std::nullopt);
    return pressures;
  }

  bool is_cell_centred() const { return options_.reconstruction == "cell_centred"; }

  bool is_nodal() const { return rock_.displacement().spec().location == Location::node; }

  int end_cell(int fracture, bool at_end) const {
    const Fracture& cells = mesh_.fractures[fracture];
    return at_end ? cells.first_cell + cells.cell_count - 1 : cells.first_cell;
  }

  int cell_at(const Point& x) const {
    const int cell = last_cell_ = location_.cell_at(x, last_cell_);
    if (cell == none) throw std::runtime_error(fmt::format("({:.6g} m, {:.6g} m) is outside of the rock", x[0], x[1]));
    return cell;
  }

  /// The difference of nodal displacements that are means of cells, in the middle of each fracture cell.
  Vector jump_between_cells() const {
    Vector jump(dimension * mesh_.fracture_cell_count());
    for (int i = 0; i < mesh_.fracture_cell_count(); ++i) {
      const FractureCell& cell = mesh_.fracture_cells[i];
      Point side[2];
      for (int k = 0; k < 2; ++k)
        side[k] = displacement_.at<dimension>(mesh_.face_cells[cell.faces[k]][0], cell.center);
      const Point difference = side[1] - side[0];
      jump.segment<dimension>(dimension * i) = cell.to_local(difference);
    }
    return jump;
  }

  const Mesh& mesh_;
  TwoLevelOptions options_;
  RockState& rock_;
  RockWalls& walls_;
  FractureFluid* fluid_;
  std::string fluid_left_out_;  ///< a component of the scene that the coupler does not stand between
  Contacts contacts_;
  const MovingTips* moving_;  ///< nullptr where the tips do not move
  PointLocation location_;
  mutable int last_cell_ = none;  ///< the cell of the last place that was looked for: the next is often in it, too
  NodalValues displacement_, pore_stress_;
  mutable std::optional<PressureNearTips> near_tips_;  ///< once a fluid that passes the walls is known to load the rock
  mutable std::optional<NodalValues> accepted_fit_;    ///< as pore_stress_, of the accepted pressure alone
  mutable std::optional<PressureNearTips> accepted_near_tips_;  ///< as near_tips_, of the accepted pressure
  std::vector<AlongFracture> along_;
  Vector traction_, jump_, fluid_traction_;
  std::uint64_t updated_for_ = 0;
  mutable std::uint64_t compared_for_ = 0;  ///< version of the properties for which is_uniform_ has been found
  mutable std::uint64_t borders_for_ = 0;   ///< for which stiffness_borders_ was made
  mutable std::vector<Border> stiffness_borders_;
  mutable bool is_uniform_ = true;  ///< whether one stiffness holds everywhere
};

const RegisterCoupler<TwoLevel, TwoLevelOptions> registration("two_level");

}  // namespace
}  // namespace sprekk::couplers
