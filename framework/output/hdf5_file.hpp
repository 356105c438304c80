// Named arrays in an HDF5 file. Every array carries a checksum, so that a damaged file is noticed when it is read.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/output/hdf5_module/hdf5_module.hpp"

namespace sprekk {

/// Thrown when the file itself is wrong: it is no HDF5 file, or an array is missing, damaged or of another kind.
struct Hdf5Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes named arrays. Names are paths "group/array"; groups are made as needed. Nothing is written to the disk before
/// `close`. The same arrays give the same bytes. Throws Hdf5Error.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(std::filesystem::path file);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  void doubles(const std::string& path, std::span<const double> values);
  void integers(const std::string& path, std::span<const int> values);
  void text(const std::string& path, const std::string& value);
  /// Replaces the file in one go. Throws std::runtime_error, with the name of the file, when it cannot be written; the
  /// old file is then still complete.
  void close();

 private:
  void write(const std::string& path, Hdf5Module::Type type, std::size_t count, const void* values);
  std::filesystem::path path_;
  std::unique_ptr<Hdf5Module::Output> file_;
  std::set<std::string> groups_;  ///< that have been made
};

/// Reads the arrays of a file that Hdf5Writer has written, and compares their checksums. Throws Hdf5Error.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& file);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  std::vector<double> doubles(const std::string& path) const;
  std::vector<int> integers(const std::string& path) const;
  std::string text(const std::string& path) const;
  std::vector<std::string> texts(const std::string& path) const;  ///< reads a text that is a list of texts in JSON
  bool has(const std::string& path) const;                        ///< whether the path exists; its group must exist

 private:
  template <class Value>
  std::vector<Value> read(const std::string& path, Hdf5Module::Type type) const;
  std::unique_ptr<Hdf5Module::Input> file_;
};

}  // namespace sprekk
