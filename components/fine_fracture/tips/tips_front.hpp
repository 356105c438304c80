// Growth within a step: the tips propose paths, and learn from the state at the end of the step on the mesh with them.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/fine_fracture/growth/arc.hpp"
#include "components/fine_fracture/growth/front.hpp"
#include "components/fine_fracture/growth/jump.hpp"
#include "components/fine_fracture/tips/tips.hpp"

namespace sprekk::fine_fracture {

/// rad, from the x axis.
inline double angle_of(const Point& direction) { return std::atan2(direction[1], direction[0]); }

/// The search for the tips of one model. The model may be rewound meanwhile.
class TipsFront : public FrontSearch {
 public:
  TipsFront(Tips& tips, const StepTime& step, bool may_shrink, bool goes_on);

  bool is_needed() const { return !paths_.empty(); }
  const std::vector<PathExtension>& paths() const override { return paths_; }
  Verdict learn(Growing& trial, const StepTime& step) override;
  Verdict conclude(Growing& trial, const StepTime& step) override;
  Verdict give_up(int path, const std::string& why) override;
  bool retreat() override;
  /// Tips that are blocked stop; everything else stays.
  void finish_without_growth() { finish(tips_); }
  std::string reason() const override { return reason_; }
  double retry_dt() const override;

 private:
  /// What of the last segment is laid anew.
  struct Segment {
    std::vector<Point> before;  ///< points of the path before the anchor
    int replaced = 0;           ///< fracture cells that are given up
  };
  static FrontState state_of(const Tips& tips, const Tips::Tip& tip);
  double part_by_turn(const Tips::Tip& tip) const;
  double what_stays(const Tips::Tip& tip, const FrontTip& start) const;
  double speed(std::size_t tip) const;
  void expect_speeds();
  void add(Tips::Tip& tip);
  void end_blocked();
  void propose();
  Tips::Tip* same_tip(Tips& there, int tip) const;
  FrontState state_in_trial(const Tips& there, const Tips::Tip& same, std::size_t tip) const;
  Verdict decide();
  Verdict finish(Tips& there);
  Verdict settle_for_less();
  bool begin_jump();
  void note_rest(double worst);
  void note_rough_front();
  Verdict end_jump();
  std::string why_it_ends() const;  ///< the jump, as a part of a sentence

  Tips& tips_;
  std::vector<Segment> segments_;
  std::vector<FrontTip> at_start_;
  std::vector<FrontState> states_, without_growth_;  ///< of the last trial; of the step without growth
  std::vector<double> scale_;      ///< Pa sqrt(m), K of viscous tips at the speed that is expected; 0 of others
  std::vector<char> is_blocked_;   ///< tips that stop in this step
  std::vector<char> is_followed_;  ///< by the mesh, from the start of the step on
  std::vector<PathExtension> joinings_;
  FrontOptions options_;
  std::unique_ptr<Front> front_;
  std::unique_ptr<FrontJump> jump_;  ///< where the front was not found in the shortest step
  std::vector<PathExtension> paths_;
  std::vector<int> tip_of_path_;
  std::optional<std::uint64_t> topology_;  ///< of the meshes of both levels in the last trial
  std::vector<Tips::EndNote> notes_;
  std::string reason_;
  double dt_;
  bool may_shrink_;
  bool goes_on_;  ///< tips that grew in the last step do so in the first trial: the step has not been solved without
};

}  // namespace sprekk::fine_fracture
