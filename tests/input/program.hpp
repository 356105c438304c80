// Runs the real program, as a user does.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sprekk::testing {

struct Outcome {
  int code = -1;  ///< the exit code; minus the signal's number when one ended the program
  std::string out, err;
};

/// A folder of its own for each test, removed afterwards.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// The program while it runs, in a working directory, with its output in files of a folder of its own.
class Program {
 public:
  Program(const std::vector<std::string>& arguments, const std::filesystem::path& working_directory);
  void interrupt() const;  ///< Ctrl-C
  void signal(int number) const;
  bool is_running();
  Outcome wait();

 private:
  Folder output_;
  pid_t process_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

/// Runs a line of the shell in which "$sprekk" is the program.
Outcome shell_command(const std::string& line, const std::filesystem::path& working_directory);

/// Runs `sprekk arguments…` to its end.
Outcome sprekk_command(const std::vector<std::string>& arguments, const std::filesystem::path& working_directory);

std::string text_of(const std::filesystem::path& file);

inline std::string config(const std::string& name) { return std::string(SPREKK_SOURCE_DIR) + "/configs/" + name; }

}  // namespace sprekk::testing
