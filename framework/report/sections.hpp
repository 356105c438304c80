// The parts of a report, each as HTML; "" when the run has nothing of the kind.
#pragma once

#include <string>

#include "framework/picture/history_panel.hpp"
#include "framework/report/run_results.hpp"

namespace sprekk {

std::string summary_section(const RunResults& results);      ///< what ran, how it went, and the result figures
std::string history_section(const RunResults& results);      ///< columns of history.csv against time
std::string tip_section(const RunResults& results);          ///< columns of the tips: "component.tip.quantity"
std::string fracture_section(const RunResults& results);     ///< fields along the fractures, and their paths
std::string events_section(const RunResults& results);       ///< the rows of events.csv
std::string map_section(const RunResults& results);          ///< fields of the matrix, drawn by the page's script
std::string convergence_section(const RunResults& results);  ///< iterations and residuals
std::string effort_section(const RunResults& results);       ///< seconds, calls, reuses, skips, counters
std::string parameter_section(const RunResults& results);    ///< every parameter with its origin

/// A column "component.thing.quantity[unit]" of a tip, or of another named thing of a component.
struct ThingColumn {
  std::string thing, quantity, unit;
  int column;
};
/// The columns of history.csv whose names have these three parts, in their order.
std::vector<ThingColumn> thing_columns(const CsvTable& history);

/// Points that are no curve: for add_event_points.
HistoryCurve event_points();
/// Adds the places of a curve at which the thing that it belongs to has an event.
void add_event_points(HistoryCurve& points, const CsvTable& events, const std::string& thing,
                      const HistoryCurve& curve);

}  // namespace sprekk
