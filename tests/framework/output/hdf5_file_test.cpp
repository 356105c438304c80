#include "framework/output/hdf5_file.hpp"

#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

class Hdf5File : public TemporaryFolder {
 protected:
  std::filesystem::path file = folder / "a.h5";
};

TEST_F(Hdf5File, ArraysComeBackToTheBit) {
  const std::vector<double> doubles = {1.0 / 3, -0.0, 5e-324, std::nan("7"), std::numeric_limits<double>::infinity()};
  const std::vector<int> integers = {-1, 0, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
  const std::string text("line\n\0and more\xff", 15);
  const std::vector<double> many(3'000'001, 0.1);  // several chunks, the last one not full
  Hdf5Writer writer(file);
  writer.doubles("a/b/doubles", doubles);
  writer.integers("a/integers", integers);
  writer.text("text", text);
  writer.doubles("many", many);
  writer.doubles("none", {});
  writer.text("no text", "");
  writer.close();

  const Hdf5Reader reader(file);
  const auto read = reader.doubles("a/b/doubles");
  ASSERT_EQ(read.size(), doubles.size());
  EXPECT_EQ(std::memcmp(read.data(), doubles.data(), sizeof(double) * read.size()), 0);
  EXPECT_EQ(reader.integers("a/integers"), integers);
  EXPECT_EQ(reader.text("text"), text);
  EXPECT_EQ(reader.doubles("many"), many);
  EXPECT_TRUE(reader.doubles("none").empty());
  EXPECT_EQ(reader.text("no text"), "");
  EXPECT_TRUE(reader.has("text"));
  EXPECT_FALSE(reader.has("missing"));
}

TEST_F(Hdf5File, TheSameArraysGiveTheSameBytesAtAnyTime) {
  const auto bytes = [&] {
    Hdf5Writer writer(file);
    writer.text("a/b/text", "some");
    writer.doubles("a/doubles", std::vector<double>(300'000, 0.1));
    writer.integers("c/integers", std::vector<int>{1, 2});
    writer.close();
    return read_text(file);
  };
  const std::string first = bytes();
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 would count seconds
  EXPECT_TRUE(bytes() == first);
}

TEST_F(Hdf5File, WhatIsMissingOrOfAnotherKindIsAnError) {
  {
    Hdf5Writer writer(file);
    writer.doubles("doubles", std::vector<double>{1, 2});
    writer.close();
  }
  const Hdf5Reader reader(file);
  EXPECT_THROW(reader.doubles("missing"), Hdf5Error);
  EXPECT_THROW(reader.integers("doubles"), Hdf5Error);
  EXPECT_THROW(reader.text("doubles"), Hdf5Error);
  EXPECT_THROW(Hdf5Reader(folder / "none.h5"), Hdf5Error);
  Hdf5Writer nowhere(folder / "missing" / "a.h5");
  nowhere.text("a", "b");
  EXPECT_THROW(nowhere.close(), std::runtime_error);
}

TEST_F(Hdf5File, AChangedByteInAnArrayIsNoticed) {
  const std::vector<double> values(1000, 1.0 / 3);
  {
    Hdf5Writer writer(file);
    writer.doubles("doubles", values);
    writer.close();
  }
  std::string bytes = read_text(file);
  const std::string pattern(reinterpret_cast<const char*>(values.data()), 8 * sizeof(double));
  const std::size_t data = bytes.find(pattern);
  ASSERT_NE(data, std::string::npos);
  bytes[data + 17] ^= 1;
  write_text(file, bytes);
  EXPECT_THROW(Hdf5Reader(file).doubles("doubles"), Hdf5Error);
}

}  // namespace
}  // namespace sprekk
