#include "framework/command_line/command_line.hpp"

int main(int argc, char** argv) { return sprekk::run_command_line(argc, argv); }
