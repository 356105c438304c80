#include "framework/results/run_datum.hpp"

#include <fmt/format.h>

#include "framework/config/expression.hpp"
#include "framework/config/quantity_scale.hpp"
#include "framework/results/field_of_run.hpp"
#include "framework/round_off.hpp"

namespace sprekk {
Data read_run_datum(const Node& node, const DataRequest& request) {
  require_known_keys(node, {"run", "of", "at"}, request);
  const Node& folder = *node.find("run");
  const Node& of = required_entry(node, "of", request);
  const std::string field = read_scalar(of, request.name + ".of");
  const auto run = std::make_shared<const FieldOfRun>(read_scalar(folder, request.name + ".run"), field, of.origin);
  const double scale = scale_to_si(run->unit(), request.about.unit, run->unit(), of.origin, field);
  std::optional<double> fixed;
  if (const Node* at = node.find("at")) {
    if (at->is_scalar() && at->scalar == "end")
      fixed = run->last_time();
    else
      fixed = read_number(*at, "s", {}, request.name + ".at");
    if (*fixed < run->first_time() || *fixed > run->last_time())
      throw InputError(at->origin, fmt::format("the run has no {} at {} s", field, *fixed),
                       fmt::format("it has written fields from {} s to {} s", run->first_time(), run->last_time()),
                       "choose a time between them, or 'end'");
  }
  if (!fixed && run->time_count() <= 2)
    throw InputError(of.origin, fmt::format("the run has {} at its start and end only", field),
                     "what changes with time needs more",
                     "write 'at: end' for a field that stays, or run it again with 'output: {every: …}'");
  return Data(
      [run, scale, fixed, where = of.origin, name = request.name](const Place& place) {
        if (run->is_on_fractures() && place.fracture < 0)
          throw DataError(fmt::format("{}: {} is a field on fractures, and is needed elsewhere, at {}", where.text(),
                                      quoted(name), place_text(place)));
        const double t = fixed.value_or(place.t), rounding = rounding::same * (run->last_time() - run->first_time());
        if (t < run->first_time() - rounding || t > run->last_time() + rounding)
          throw DataError(
              fmt::format("{}: {} has no value at t = {} s (the run has written it from {} s to {} s: write "
                          "'at: end' for a field that stays)",
                          where.text(), quoted(name), t, run->first_time(), run->last_time()));
        try {
          return scale * run->at({place.x[0], place.x[1]}, place.fracture, t);
        } catch (const DataError&) {
          throw;
        } catch (const std::runtime_error& error) {
          throw DataError(fmt::format("{}: {}: {}", where.text(), quoted(name), error.what()));
        }
      },
      !fixed, true);
}

}  // namespace sprekk
