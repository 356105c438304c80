#include "framework/command_line/command_line.hpp"
#include "framework/command_line/keep_memory.hpp"
#include "templates.hpp"

int main(int argc, char** argv) {
  sprekk::keep_memory();
  return sprekk::run_command_line(
      argc, argv,
      {"coupled simulations of fractured porous rock",
       "Sprekk simulates fractured porous rock: coupled flow, deformation, friction and opening of fractures.",
       templates});
}
