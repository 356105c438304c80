#define SPREKK_VERSION "0.0.0"
#include "framework/module/define_module.hpp"

namespace {
struct Interface {
  virtual ~Interface() = default;
};
struct Nothing final : Interface {};
}  // namespace

SPREKK_DEFINE_MODULE(Interface, Nothing)
