#include "framework/output/hdf5_file.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "framework/module/module.hpp"
#include "framework/output/atomic_file.hpp"

namespace sprekk {
namespace {

using Type = Hdf5Module::Type;

const Hdf5Module& hdf5() { return module<Hdf5Module>("hdf5"); }

/// What is wrong with the file becomes an Hdf5Error.
template <class Work>
auto of_file(const Work& work) {
  try {
    return work();
  } catch (const std::runtime_error& error) {
    throw Hdf5Error(error.what());
  }
}

}  // namespace

Hdf5Writer::Hdf5Writer(std::filesystem::path file) : path_(std::move(file)) {
  const Hdf5Module& module = hdf5();  // where it cannot be opened, nothing is wrong with the file
  file_ = of_file([&] { return module.make(path_); });
}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::close() {
  write_atomically(path_, of_file([&] { return file_->finish(); }));
}

void Hdf5Writer::write(const std::string& path, Type type, std::size_t count, const void* values) {
  of_file([&] {
    for (std::size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1)) {
      const std::string group = path.substr(0, end);
      if (groups_.insert(group).second) file_->make_group(group);
    }
    file_->write(path, type, count, values);
  });
}

void Hdf5Writer::doubles(const std::string& path, std::span<const double> values) {
  write(path, Type::number, values.size(), values.data());
}

void Hdf5Writer::integers(const std::string& path, std::span<const int> values) {
  write(path, Type::integer, values.size(), values.data());
}

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  write(path, Type::character, value.size(), value.data());
}

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) {
  const Hdf5Module& module = hdf5();
  file_ = of_file([&] { return module.open(file); });
}

Hdf5Reader::~Hdf5Reader() = default;

template <class Value>
std::vector<Value> Hdf5Reader::read(const std::string& path, Type type) const {
  return of_file([&] {
    std::vector<Value> values(file_->size_of(path, type));
    if (!values.empty()) file_->read(path, type, values.data());
    return values;
  });
}

std::vector<double> Hdf5Reader::doubles(const std::string& path) const { return read<double>(path, Type::number); }

std::vector<int> Hdf5Reader::integers(const std::string& path) const { return read<int>(path, Type::integer); }

std::string Hdf5Reader::text(const std::string& path) const {
  const std::vector<char> characters = read<char>(path, Type::character);
  return {characters.begin(), characters.end()};
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path) const {
  return nlohmann::json::parse(text(path)).get<std::vector<std::string>>();
}

bool Hdf5Reader::has(const std::string& path) const { return file_->has(path); }

}  // namespace sprekk
