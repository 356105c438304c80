#include <dlfcn.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

#include "framework/linear/linear_solver.hpp"

namespace sprekk {
namespace {

std::string library_of(void* symbol) {
  Dl_info info;
  if (symbol == nullptr || dladdr(symbol, &info) == 0 || info.dli_fname == nullptr) return "";
  // Debian's alternatives are symbolic links; the last target is the library in use.
  std::error_code error;
  const auto real = std::filesystem::canonical(info.dli_fname, error);
  return error ? info.dli_fname : real.string();
}

std::string trimmed(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  return text;
}

}  // namespace

BlasInfo blas_in_use() {
  using Config = char* (*)();
  void* const dgemm = dlsym(RTLD_DEFAULT, "dgemm_");
  std::string path = library_of(dgemm);
  std::transform(path.begin(), path.end(), path.begin(), [](unsigned char c) { return std::tolower(c); });

  // OpenBLAS may be loaded without being the library of dgemm_, so its name counts only if dgemm_ belongs to it.
  if (path.find("openblas") != std::string::npos) {
    if (const auto config = reinterpret_cast<Config>(dlsym(RTLD_DEFAULT, "openblas_get_config")))
      return {trimmed(config()), false};
    return {"OpenBLAS", false};
  }
  struct Known {
    const char* part;
    const char* name;
  };
  for (const Known& known : {Known{"mkl", "MKL"}, Known{"blis", "BLIS"}, Known{"atlas", "ATLAS"}})
    if (path.find(known.part) != std::string::npos) return {known.name, false};
  if (path.find("libblas") != std::string::npos) return {"reference BLAS (" + path + ")", true};
  return {path.empty() ? "none" : path, false};
}

void use_one_blas_thread() {
  static const bool done = [] {
    using SetThreads = void (*)(int);
    if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(1);
    return true;
  }();
  (void)done;
}

}  // namespace sprekk
