// The part of HDF5 that Sprekk uses: files of named arrays, each with a checksum.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace sprekk {

/// The module "hdf5". All functions throw std::runtime_error with what is wrong with the file.
class Hdf5Module {
 public:
  /// Of the values of an array: double, int, char.
  enum class Type { number, integer, character };

  /// A file that is made in memory.
  class Output {
   public:
    virtual ~Output() = default;
    virtual void make_group(const std::string& path) = 0;
    virtual void write(const std::string& path, Type type, std::size_t count, const void* values) = 0;
    /// The bytes of the file, to which nothing can be written any more; valid as long as this object.
    virtual std::string_view finish() = 0;
  };

  /// A file on the disk.
  class Input {
   public:
    virtual ~Input() = default;
    /// The number of values of an array, which has to be of the given type.
    virtual std::size_t size_of(const std::string& path, Type type) const = 0;
    /// All values of an array, of which `size_of` has told the number.
    virtual void read(const std::string& path, Type type, void* values) const = 0;
    /// Whether the path exists; its group must exist.
    virtual bool has(const std::string& path) const = 0;
  };

  virtual ~Hdf5Module() = default;
  /// `file`: its name, which the bytes do not depend on.
  virtual std::unique_ptr<Output> make(const std::filesystem::path& file) const = 0;
  virtual std::unique_ptr<Input> open(const std::filesystem::path& file) const = 0;
};

}  // namespace sprekk
