// A field that another run has written, at any place and time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/config/input_error.hpp"
#include "framework/results/cell_sampler.hpp"

namespace sprekk {

/// A field in a folder of results: linear between the written times, constant before the first and after the last one;
/// between cells as in SampledArray, on the mesh of the written time. Files are read when they are needed.
class FieldOfRun {
 public:
  /// `field`: "pore.pressure"; a component of a vector or tensor as in "rock.displacement.x", "rock.stress.xy" or
  /// "contact.jump.normal". Throws InputError, for `where`, if the folder holds no results, or if its first file does
  /// not have this field.
  FieldOfRun(std::filesystem::path folder, const std::string& field, const Origin& where);
  ~FieldOfRun();

  const std::string& unit() const { return unit_; }  ///< SI, "" for a plain number
  bool is_on_fractures() const { return is_on_fractures_; }
  std::size_t time_count() const { return snapshots_.size(); }   ///< number of written times
  double first_time() const { return snapshots_.front().time; }  ///< s
  double last_time() const { return snapshots_.back().time; }    ///< s
  /// `fracture`: its number, for fields on fractures. Throws std::runtime_error where the run has no such place or its
  /// files cannot be read.
  double at(const Position& place, int fracture, double time) const;

 private:
  struct Frame;
  const Frame& frame(std::size_t snapshot) const;

  std::filesystem::path folder_;
  std::vector<Snapshot> snapshots_;
  std::string array_, unit_;  ///< name of the array in the files, "quantity[unit]"
  int component_ = 0;
  bool is_on_fractures_ = false;
  mutable std::vector<std::unique_ptr<Frame>> frames_;  ///< the two frames that were used last
};

}  // namespace sprekk
