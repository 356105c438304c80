// Part of each plug-in: asks the program for the interface that the plug-in was built for.
#include "framework/plugin/interface_name.hpp"

extern "C" const char SPREKK_INTERFACE;
extern "C" __attribute__((visibility("default"))) const char* const sprekk_plugin = &SPREKK_INTERFACE;
