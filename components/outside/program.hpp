// The component: its fields, and when its program is asked for their values.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/outside/conversation.hpp"
#include "components/outside/options.hpp"
#include "framework/assembly/counts_work.hpp"
#include "framework/assembly/keeps_state.hpp"
#include "framework/outside/solved_outside.hpp"
#include "framework/scene/component.hpp"

namespace sprekk::outside {

/// A component that is another program. Unknown: x of each field that it gives. Row: x − P = 0, with P what the program
/// answers for the present values of all other fields, and for what couplers add to the rows of x, its loads.
///
/// In a solve of its own the program is asked once, and x becomes P. Where the equations of an iteration are checked,
/// it is asked for the present values: x − P is then what the next pass would change x by. This is the residual, over
/// the largest value of x. What it was asked last is not asked again.
class Program : public Component, public KeepsState, public SolvedOutside, public CountsWork {
 public:
  Program(const ComponentContext& context, const Options& options);

  const std::string& component() const override { return name(); }
  const Origin& origin() const override { return origin_; }
  void require_command() const override;
  void join_run(const std::vector<Part*>& parts) override;

  void evaluate_data(const StepTime& step) override;
  void begin_step(const StepTime& step) override { step_ = step; }
  void assemble(Assembly&, const StepTime&) const override {}
  void constrain(Assembly& assembly) const override;
  void note_input(Notes& notes) const override;
  void note_step(Notes& notes, const StepTime& step) const override;

  void accepted() override;
  void rewound() override;
  void save(std::map<std::string, Vector>& state) const override;
  void restore(const std::map<std::string, Vector>& state) override;
  std::map<std::string, long> counts() const override;
  std::vector<ProfileEntry> efforts() const override;

 protected:
  Field& given(const std::string& role) const;  ///< the field that is given as this
  const Vector& initial(const std::string& role) const;
  /// What else the program is told at the start of a step, by names after that of the field.
  virtual void tell_more(OutsideMessage&) const {}

 private:
  /// A field that the program gives.
  struct Given {
    GivenOptions options;
    Field* field;
    Vector initial;
    bool has_loads;     ///< whether others may add terms to its rows
    Operator identity;  ///< where `fix` puts what it knows of the rows
  };
  /// What the program was asked last, and has answered.
  struct Asked {
    StepTime step;
    std::vector<std::uint64_t> versions;  ///< of all fields of others
    OutsideMessage fields;
    std::vector<Vector> answer;  ///< of each field that it gives
  };

  bool is_own(const Field& field) const;
  std::vector<std::uint64_t> versions_of_others() const;
  OutsideMessage fields_for(const Assembly& assembly) const;
  /// P of each field; nullptr where it is not to be asked for.
  const std::vector<Vector>* answer(const Assembly& assembly, bool is_alone) const;
  std::vector<Vector> ask(OutsideMessage fields) const;
  OutsideMessage hello() const;
  /// Holds a field where it is.
  static void hold(Assembly& assembly, const Field& field, double scale);
  /// Tells the error of a field as the residual of its rows, and returns it.
  static double fix_error(Assembly& assembly, const Field& field, const Vector& answer);

  const Mesh& mesh_;
  FieldStore& fields_;
  Origin origin_;
  Options options_;
  std::vector<Given> given_;
  std::vector<const Field*> taken_;
  bool has_joined_ = false;
  double start_time_;
  StepTime step_;
  std::map<std::string, Vector> kept_at_restart_;
  // The program is asked while equations are assembled, which changes nothing else of the part.
  mutable std::unique_ptr<Conversation> conversation_;
  mutable std::optional<Asked> asked_;
  mutable double error_ = 0, error_before_ = 0;  ///< of the last two checks in an iteration
};

}  // namespace sprekk::outside
