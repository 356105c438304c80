#include "framework/output/hdf5_module/hdf5_module.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "framework/module/define_module.hpp"

namespace sprekk {
namespace {

/// A guard that closes an HDF5 object.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error(what);
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t status, const std::string& what) {
  if (status < 0) throw std::runtime_error(what);
}

/// Switches off HDF5's own messages on the terminal; errors are reported by exceptions.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// Without the time at which an object was made, the same values give the same bytes.
void leave_time_out(hid_t creation) { require(H5Pset_obj_track_times(creation, false), "out of memory"); }

hid_t native(Hdf5Module::Type type) {
  switch (type) {
    case Hdf5Module::Type::number:
      return H5T_NATIVE_DOUBLE;
    case Hdf5Module::Type::integer:
      return H5T_NATIVE_INT;
    default:
      return H5T_NATIVE_CHAR;
  }
}

constexpr std::size_t memory_step = std::size_t{1} << 22;  // bytes by which a file in memory grows
constexpr hsize_t largest_chunk = hsize_t{1} << 20;        // values; the chunks carry the checksums

/// The bytes of a file that HDF5 keeps in memory. HDF5 frees them when it closes the file; this object takes them over.
/// H5Fget_file_image would be simpler, but its image has a wrong checksum (HDF5 1.10.8).
struct Image {
  void* bytes = nullptr;
  std::size_t size = 0;  ///< a multiple of memory_step
  ~Image() { std::free(bytes); }

  /// The length of the file as its superblock gives it (HDF5 file format 3.0, "Superblock versions 2 and 3"); 0 without
  /// a superblock.
  std::size_t used() const {
    constexpr std::size_t version = 8, end_of_file = 28, length = 48;  // bytes, as the format has them
    const auto* block = static_cast<const unsigned char*>(bytes);
    if (!bytes || size < length || (block[version] != 2 && block[version] != 3)) return 0;
    std::uint64_t end = 0;
    for (std::size_t i = 8; i-- > 0;) end = end << 8 | block[end_of_file + i];
    return end <= size ? end : 0;
  }

  // Zeros, since HDF5 leaves gaps.
  static void* make(std::size_t size, H5FD_file_image_op_t, void*) { return std::calloc(size, 1); }
  static void* copy(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::memcpy(to, from, size);
  }
  static void* resize(void* bytes, std::size_t size, H5FD_file_image_op_t, void* image) {
    const std::size_t former = std::exchange(static_cast<Image*>(image)->size, size);
    void* const larger = std::realloc(bytes, size);
    if (larger && size > former) std::memset(static_cast<char*>(larger) + former, 0, size - former);
    return larger;
  }
  static herr_t release(void* bytes, H5FD_file_image_op_t reason, void* image) {
    if (reason == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
      static_cast<Image*>(image)->bytes = bytes;
    else
      std::free(bytes);
    return 0;
  }
  static void* share(void* image) { return image; }
  static herr_t keep(void*) { return 0; }
  H5FD_file_image_callbacks_t callbacks() { return {make, copy, resize, release, share, keep, this}; }
};

class FileInMemory final : public Hdf5Module::Output {
 public:
  explicit FileInMemory(const std::filesystem::path& file) {
    silence();
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "out of memory");
    // The latest format also has checksums on the structures of the file.
    H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    // The file is made in memory: after a failure to write, HDF5 would try again at the end of the program, and crash.
    require(H5Pset_fapl_core(access, memory_step, 0), "out of memory");
    H5FD_file_image_callbacks_t callbacks = image_.callbacks();
    require(H5Pset_file_image_callbacks(access, &callbacks), "out of memory");
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "out of memory");
    leave_time_out(creation);
    file_ = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation, access);
    if (file_ < 0) throw std::runtime_error("the file cannot be made");
  }
  ~FileInMemory() override {
    if (file_ >= 0) H5Fclose(file_);
  }

  void make_group(const std::string& path) override {
    const std::string failed = "group " + path + " cannot be made";
    const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, failed);
    leave_time_out(creation);
    const Handle made(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, failed);
  }

  void write(const std::string& path, Hdf5Module::Type type, std::size_t count, const void* values) override {
    const std::string failed = "array " + path + " cannot be written";
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, failed);
    leave_time_out(creation);
    const hsize_t size = count;
    if (size > 0) {
      const hsize_t chunk = std::min(size, largest_chunk);
      require(H5Pset_chunk(creation, 1, &chunk), failed);
      require(H5Pset_fletcher32(creation), failed);
    }
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, failed);
    const Handle array(H5Dcreate2(file_, path.c_str(), native(type), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                       H5Dclose, failed);
    if (size > 0) require(H5Dwrite(array, native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), failed);
  }

  std::string_view finish() override {
    const std::string failed = "the file cannot be finished";
    const herr_t closed = H5Fclose(std::exchange(file_, -1));
    require(closed, failed);
    const std::size_t size = image_.used();
    if (size == 0) throw std::runtime_error(failed);
    return {static_cast<const char*>(image_.bytes), size};
  }

 private:
  Image image_;
  hid_t file_ = -1;
};

class FileOnDisk final : public Hdf5Module::Input {
 public:
  explicit FileOnDisk(const std::filesystem::path& file) {
    silence();
    file_ = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0) throw std::runtime_error("it is cut short or not an HDF5 file");
  }
  ~FileOnDisk() override { H5Fclose(file_); }

  std::size_t size_of(const std::string& path, Hdf5Module::Type type) const override {
    const Handle array(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, "array " + path + " is missing");
    const Handle stored_type(H5Dget_type(array), H5Tclose, "array " + path + " is damaged");
    if (H5Tget_class(stored_type) != H5Tget_class(native(type)) ||
        H5Tget_size(stored_type) != H5Tget_size(native(type)))
      throw std::runtime_error("array " + path + " is of another kind");
    const Handle space(H5Dget_space(array), H5Sclose, "array " + path + " is damaged");
    hsize_t size = 0;
    if (H5Sget_simple_extent_ndims(space) != 1 || H5Sget_simple_extent_dims(space, &size, nullptr) != 1)
      throw std::runtime_error("array " + path + " is of another shape");
    return size;
  }

  void read(const std::string& path, Hdf5Module::Type type, void* values) const override {
    const Handle array(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, "array " + path + " is missing");
    require(H5Dread(array, native(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "array " + path + " is damaged");
  }

  bool has(const std::string& path) const override { return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0; }

 private:
  hid_t file_ = -1;
};

class Module final : public Hdf5Module {
 public:
  std::unique_ptr<Output> make(const std::filesystem::path& file) const override {
    return std::make_unique<FileInMemory>(file);
  }
  std::unique_ptr<Input> open(const std::filesystem::path& file) const override {
    return std::make_unique<FileOnDisk>(file);
  }
};

}  // namespace
}  // namespace sprekk

SPREKK_DEFINE_MODULE(sprekk::Hdf5Module, sprekk::Module)
