// Reads mesh files with mistakes drawn at random; tools/stress --meshes runs it under the sanitizers.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

#include "tests/framework/meshing/mutated_meshes.hpp"

namespace {

constexpr double longest = 10;  // seconds for a file of some kilobytes, in a program that the sanitizers slow down

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

/// mutated_meshes SEED FIRST COUNT: exit code 1 if a file was neither read nor refused with a message.
int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const unsigned seed = static_cast<unsigned>(std::strtoul(argv[1], nullptr, 10));
  const int first = std::atoi(argv[2]), count = std::atoi(argv[3]);
  const std::vector<std::string> meshes = sprekk::test::meshes_of_gmsh();
  const std::string file =
      (std::filesystem::temp_directory_path() / ("sprekk_mutated_" + std::to_string(getpid()) + ".msh")).string();
  int failed = 0;
  for (int number = first; number < first + count; ++number) {
    std::mt19937 random(seed * 1000003u + static_cast<unsigned>(number));
    const std::string bytes = sprekk::test::mutated(meshes[number % meshes.size()], random);
    std::ofstream(file, std::ios::binary) << bytes;
    const double began = seconds();
    std::string failure = sprekk::test::failure_of_reading(file);
    if (failure.empty() && seconds() - began > longest) failure = "it took " + std::to_string(seconds() - began) + " s";
    if (failure.empty()) continue;
    ++failed;
    std::cout << "file " << number << " of seed " << seed << ": " << failure << std::endl;
  }
  std::filesystem::remove(file);
  std::cout << count << " mesh files with mistakes, " << failed << " failed" << std::endl;
  return failed > 0 ? 1 : 0;
}
