// Events of a run: the rows of events.csv.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// A process that went on by itself once it had begun, while the loads changed hardly or not at all.
struct Event {
  std::string kind;               ///< one word
  std::string thing;              ///< "component.thing", or a component
  double begin, end;              ///< s; equal where it took no time
  Point place;                    ///< m
  std::vector<Quantity> figures;  ///< with names and units as in event_figures()
  std::string reason;             ///< why it has ended there, or begun
};

/// Capability: a part that reports events.
class TellsEvents {
 public:
  virtual ~TellsEvents() = default;
  /// Names and units of the figures that its events may have; the values mean nothing. Parts may share figures.
  virtual std::vector<Quantity> event_figures() const = 0;
  /// The events that have ended in the step. Called when it is about to be accepted, after all notes on it. The same on
  /// all processes.
  virtual std::vector<Event> events(const StepTime& step) const = 0;
};

}  // namespace sprekk
