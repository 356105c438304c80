// Events of a run: the rows of events.csv.
#pragma once

#include <string>
#include <vector>

#include "framework/assembly/part.hpp"

namespace sprekk {

/// Something that went on by itself once it had begun, with no change of what drives the model, or hardly any.
struct Event {
  std::string kind;               ///< one word
  std::string thing;              ///< "component.thing", or a component
  double begin, end;              ///< s; equal where it took no time
  Point place;                    ///< m
  std::vector<Quantity> figures;  ///< with names and units as in event_figures()
  std::string reason;             ///< why it has ended there, or begun
};

/// Capability of parts that tell events.
class TellsEvents {
 public:
  virtual ~TellsEvents() = default;
  /// Names and units of the figures that its events may have; the values mean nothing. Parts may share figures.
  virtual std::vector<Quantity> event_figures() const = 0;
  /// The events that have ended in the step, which is about to be accepted: called after all notes on it. The same on
  /// all processes.
  virtual std::vector<Event> events(const StepTime& step) const = 0;
};

}  // namespace sprekk
