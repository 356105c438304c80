#include "framework/command_line/hand_over.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace sprekk {

void hand_over(int dimension, char** arguments) {
  const std::string ending = "-space";
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  std::string name = program.filename().string();
  if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  program.replace_filename(dimension == 3 ? name + ending : name);
  execv(program.c_str(), arguments);
  throw std::runtime_error("the program for scenes in " + std::string(dimension == 3 ? "space" : "a plane") +
                           " cannot be started: " + program.string() + " (" + std::strerror(errno) +
                           ") build or install Sprekk anew: both programs belong together");
}

}  // namespace sprekk
