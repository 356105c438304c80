#include "framework/command_line/hand_over.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace sprekk {

namespace {

/// A word of a shell's command.
std::string quoted_for_shell(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The program for this dimension, beside this one.
std::filesystem::path program_for(int dimension) {
  const std::string ending = "-space";
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  std::string name = program.filename().string();
  if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  return program.replace_filename(dimension == 3 ? name + ending : name);
}

std::runtime_error cannot_start(int dimension, const std::string& why) {
  return std::runtime_error("the program for scenes in " + std::string(dimension == 3 ? "space" : "a plane") +
                            " cannot be started: " + program_for(dimension).string() + " (" + why +
                            ") build or install Sprekk anew: both programs belong together");
}

}  // namespace

void hand_over(int dimension, char** arguments) {
  execv(program_for(dimension).c_str(), arguments);
  throw cannot_start(dimension, std::strerror(errno));
}

std::string said_by_program(int dimension, const std::string& command) {
  const std::filesystem::path program = program_for(dimension);
  if (access(program.c_str(), X_OK) != 0) throw cannot_start(dimension, std::strerror(errno));
  FILE* const pipe = popen(("exec " + quoted_for_shell(program.string()) + " " + command).c_str(), "r");
  if (!pipe) throw cannot_start(dimension, std::strerror(errno));
  std::string said;
  std::array<char, 4096> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe)) said.append(part.data(), count);
  if (pclose(pipe) != 0) throw cannot_start(dimension, "'" + command + "' failed");
  return said;
}

}  // namespace sprekk
