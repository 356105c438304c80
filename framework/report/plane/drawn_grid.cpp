#include "framework/report/drawn_grid.hpp"

namespace sprekk {

Grid drawn_grid(const std::filesystem::path& vtu) { return read_grid(vtu); }

std::vector<DrawnEdge> drawn_edges(const std::filesystem::path&) { return {}; }

}  // namespace sprekk
