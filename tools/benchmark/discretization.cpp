// Times the discretizations of flow and mechanics on unstructured triangles, on one thread.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "components/matrix_flow/mpfa/mpfa.hpp"
#include "components/matrix_flow/tpfa/tpfa.hpp"
#include "components/poromechanics/mpsa/mpsa.hpp"
#include "tests/framework/assembly/small_mesh.hpp"

namespace {

using namespace sprekk;

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A square that no fluid enters and whose faces are clamped.
void time_mesh(double size) {
  Mesh mesh;
  const double meshing = seconds([&] { mesh = test::small_mesh(size); });
  std::vector<matrix_flow::FlowCondition> flow(mesh.face_count(), matrix_flow::FlowCondition::none);
  using Mechanical = poromechanics::MechanicalCondition;
  std::vector<poromechanics::FaceConditions> mechanics(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face_cells[f][1] != none) continue;
    flow[f] = matrix_flow::FlowCondition::flux;
    mechanics[f] = {Mechanical::displacement, Mechanical::displacement};
  }
  const std::vector<Tensor> mobility(mesh.cell_count(), Tensor::Identity());
  const std::vector<poromechanics::Stiffness> stiffness(mesh.cell_count(), poromechanics::isotropic_stiffness(1, 1));
  const double tpfa = seconds([&] { matrix_flow::discretize_tpfa(mesh, mobility, flow); });
  const double mpfa = seconds([&] { matrix_flow::discretize_mpfa(mesh, mobility, flow); });
  const double mpsa = seconds([&] { poromechanics::discretize_mpsa(mesh, stiffness, mechanics); });
  std::printf("%9d  %8.2f  %8.3f  %8.3f  %12.3f\n", mesh.cell_count(), meshing, tpfa, mpfa, mpsa);
}

}  // namespace

int main() {
  std::printf("seconds, one thread, unstructured triangles\n");
  std::printf("%9s  %8s  %8s  %8s  %12s\n", "triangles", "mesh", "TPFA", "MPFA", "MPSA + Biot");
  // About 2,500, 10,000, 40,000 and 160,000 triangles: the sizes of PorePy's figures in docs/performance.md.
  for (const double size : {0.0305, 0.0152, 0.0076, 0.0038}) time_mesh(size);
}
