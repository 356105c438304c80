#include "framework/meshing/gmsh_module/gmsh_model.hpp"

#include <gmsh.h>

#include <stdexcept>

namespace sprekk {
namespace {

template <class Work>
void translate_errors(const std::string& purpose, const Work& work) {
  try {
    work();
  } catch (const std::string& message) {
    throw std::runtime_error("gmsh failed to " + purpose + " (" + message + ")");
  } catch (const char* message) {
    throw std::runtime_error("gmsh failed to " + purpose + " (" + message + ")");
  }
}

void start() {
  static bool is_running = false;
  if (is_running) return;
  gmsh::initialize(0, nullptr, false);
  is_running = true;
}

}  // namespace

GmshModel::GmshModel() {
  translate_errors("start", [] {
    start();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    // Reset of the options that callers may change for their model.
    gmsh::option::setNumber("Mesh.Algorithm", 6);
    gmsh::option::setNumber("Mesh.Smoothing", 1);
    gmsh::option::setNumber("Mesh.LcIntegrationPrecision", 1e-9);
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
    gmsh::option::setNumber("Mesh.RandomFactor", 1e-9);
    // Only the callback gives edge lengths.
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 0);
    gmsh::model::add("sprekk");
  });
}

GmshModel::~GmshModel() {
  try {
    gmsh::model::mesh::removeSizeCallback();
    gmsh::clear();
  } catch (...) {
    // An error here is harmless: the next object makes a new, empty model.
  }
}

void GmshModel::run(const std::string& purpose, const std::function<void()>& work) const {
  translate_errors(purpose, work);
}

}  // namespace sprekk
