#include "framework/output/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "framework/output/atomic_file.hpp"

namespace sprekk {
namespace {

/// A guard that closes an HDF5 object.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw Hdf5Error(what);
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
  if (status < 0) throw Hdf5Error(what);
}

/// Switches off HDF5's own messages on the terminal; errors are reported by exceptions.
void silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// Without the time at which an object was made, the same values give the same bytes.
void leave_time_out(hid_t creation) { require(H5Pset_obj_track_times(creation, false), "out of memory"); }

constexpr std::size_t memory_step = std::size_t{1} << 22;  // bytes by which a file in memory grows
constexpr hsize_t largest_chunk = hsize_t{1} << 20;        // values; the chunks carry the checksums

}  // namespace

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

/// The bytes of a file that HDF5 keeps in memory. HDF5 frees them when it closes the file; this object takes them over.
/// H5Fget_file_image would be simpler, but its image has a wrong checksum (HDF5 1.10.8).
struct Hdf5Writer::Image {
  void* bytes = nullptr;
  std::size_t size = 0;  ///< a multiple of memory_step
  ~Image() { std::free(bytes); }

  /// The length of the file as its superblock gives it (HDF5 file format 3.0, "Superblock versions 2 and 3"); 0 without
  /// a superblock.
  std::size_t used() const {
    constexpr std::size_t version = 8, end_of_file = 28, length = 48;
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

Hdf5Writer::Hdf5Writer(std::filesystem::path file) : path_(std::move(file)), image_(std::make_unique<Image>()) {
  silence();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "out of memory");
  // The latest format also has checksums on the structures of the file.
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  // The file is made in memory: after a failure to write, HDF5 would try again at the end of the program, and crash.
  require(H5Pset_fapl_core(access, memory_step, 0), "out of memory");
  H5FD_file_image_callbacks_t callbacks = image_->callbacks();
  require(H5Pset_file_image_callbacks(access, &callbacks), "out of memory");
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "out of memory");
  leave_time_out(creation);
  file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation, access);
  if (file_ < 0) throw Hdf5Error("the file cannot be made");
}

Hdf5Writer::~Hdf5Writer() {
  if (file_ >= 0) H5Fclose(file_);
}

std::string_view Hdf5Writer::finish() {
  const std::string failed = "the file cannot be finished";
  const herr_t closed = H5Fclose(file_);
  file_ = -1;
  require(closed, failed);
  const std::size_t size = image_->used();
  if (size == 0) throw Hdf5Error(failed);
  return {static_cast<const char*>(image_->bytes), size};
}

void Hdf5Writer::close() { write_atomically(path_, finish()); }

void Hdf5Writer::make_groups_of(const std::string& path) {
  for (std::size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1)) {
    const std::string group = path.substr(0, end), failed = "group " + group + " cannot be made";
    if (!groups_.insert(group).second) continue;
    const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, failed);
    leave_time_out(creation);
    const Handle made(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose, failed);
  }
}

void Hdf5Writer::write(const std::string& path, std::int64_t type, std::size_t count, const void* values) {
  const std::string failed = "array " + path + " cannot be written";
  make_groups_of(path);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, failed);
  leave_time_out(creation);
  const hsize_t size = count;
  if (size > 0) {
    const hsize_t chunk = std::min(size, largest_chunk);
    require(H5Pset_chunk(creation, 1, &chunk), failed);
    require(H5Pset_fletcher32(creation), failed);
  }
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose, failed);
  const Handle array(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                     failed);
  if (size > 0) require(H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), failed);
}

void Hdf5Writer::doubles(const std::string& path, std::span<const double> values) {
  write(path, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

void Hdf5Writer::integers(const std::string& path, std::span<const int> values) {
  write(path, H5T_NATIVE_INT, values.size(), values.data());
}

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  write(path, H5T_NATIVE_CHAR, value.size(), value.data());
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) {
  silence();
  file_ = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) throw Hdf5Error("it is cut short or not an HDF5 file");
}

Hdf5Reader::~Hdf5Reader() { H5Fclose(file_); }

template <class Value>
std::vector<Value> Hdf5Reader::read(const std::string& path, std::int64_t type) const {
  const Handle array(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, "array " + path + " is missing");
  const Handle stored_type(H5Dget_type(array), H5Tclose, "array " + path + " is damaged");
  if (H5Tget_class(stored_type) != H5Tget_class(type) || H5Tget_size(stored_type) != H5Tget_size(type))
    throw Hdf5Error("array " + path + " is of another kind");
  const Handle space(H5Dget_space(array), H5Sclose, "array " + path + " is damaged");
  hsize_t size = 0;
  if (H5Sget_simple_extent_ndims(space) != 1 || H5Sget_simple_extent_dims(space, &size, nullptr) != 1)
    throw Hdf5Error("array " + path + " is of another shape");
  std::vector<Value> values(size);
  if (size > 0)
    require(H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "array " + path + " is damaged");
  return values;
}

std::vector<double> Hdf5Reader::doubles(const std::string& path) const { return read<double>(path, H5T_NATIVE_DOUBLE); }

std::vector<int> Hdf5Reader::integers(const std::string& path) const { return read<int>(path, H5T_NATIVE_INT); }

std::string Hdf5Reader::text(const std::string& path) const {
  const std::vector<char> characters = read<char>(path, H5T_NATIVE_CHAR);
  return {characters.begin(), characters.end()};
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path) const {
  return nlohmann::json::parse(text(path)).get<std::vector<std::string>>();
}

bool Hdf5Reader::has(const std::string& path) const { return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0; }

}  // namespace sprekk
