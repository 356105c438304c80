#include "framework/command_line/compare_command.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include "framework/compare/difference_page.hpp"
#include "framework/compare/difference_tables.hpp"
#include "framework/config/input_error.hpp"
#include "framework/output/atomic_file.hpp"

namespace sprekk {

CompareCommand::CompareCommand(CLI::App& app)
    : command_(app.add_subcommand("compare", "Tells how far runs are apart: in time, in fields, in paths, in cost")) {
  command_->add_option("runs", folders_, "Folders of results; all others are compared with the first")
      ->required()
      ->type_name("FOLDER");
  tolerance_option_ =
      command_
          ->add_option("--tolerance", tolerance_,
                       "Ends with exit code 3 if a difference is a larger share of the range of its quantity")
          ->type_name("SHARE")
          ->check(CLI::NonNegativeNumber);
  command_->add_option("--of", quantities_, "Compares these quantities only: columns, fields, or paths")
      ->type_name("QUANTITY")
      ->expected(1)
      ->take_all();
  command_->add_option("--page", page_, "Writes tables and curves as an HTML page")->type_name("FILE");
  command_->add_flag("-q,--quiet", is_quiet_, "Prints nothing unless something is wrong");
}

ExitCode CompareCommand::run() const {
  if (folders_.size() < 2)
    throw InputError({"sprekk compare"}, "a comparison needs two runs", "there is one",
                     "give the folders of two runs or more");
  std::vector<ComparedRun> runs;
  for (const std::string& folder : folders_) runs.push_back(read_compared_run(folder));
  std::vector<RunDifference> differences;
  for (std::size_t i = 1; i < runs.size(); ++i)
    differences.push_back(run_difference(runs.front(), runs[i], quantities_));
  std::optional<double> tolerance;
  if (tolerance_option_->count() > 0) tolerance = tolerance_;
  if (!is_quiet_) std::cout << difference_text(runs, differences, tolerance);
  if (!page_.empty()) {
    if (const auto folder = std::filesystem::path(page_).parent_path(); !folder.empty())
      std::filesystem::create_directories(folder);
    write_atomically(page_, difference_page(runs, differences, tolerance));
    if (!is_quiet_) std::cout << "page: " << page_ << "\n";
  }
  if (!tolerance) return ExitCode::done;
  ExitCode code = ExitCode::done;
  for (const RunDifference& difference : differences) {
    if (is_within(difference, *tolerance)) continue;
    code = ExitCode::differs;
    if (is_quiet_) std::cerr << difference.other->name << ": " << verdict(difference, *tolerance) << "\n";
  }
  return code;
}

}  // namespace sprekk
