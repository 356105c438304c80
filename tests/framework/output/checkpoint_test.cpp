#include "framework/output/checkpoint.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <random>

#include "framework/output/hdf5_file.hpp"
#include "framework/output/mesh_record.hpp"
#include "tests/framework/output/small_case.hpp"

namespace sprekk {
namespace {

using testing::HasSubstr;

bool same_bits(const Vector& a, const Vector& b) {
  if (a.size() != b.size()) return false;
  return a.size() == 0 || std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0;
}

class CheckpointTest : public TemporaryFolder {
 protected:
  CheckpointTest() {
    checkpoint.scene_name = "mandel";
    checkpoint.scene_fingerprint = fingerprint("components: {}");
    checkpoint.program_version = "0.1.0";
    checkpoint.notes = {{"pore.pressure", "bad byte \" here", 0.1 + 0.2, 1.0 / 3, 7, 1e-300}, {"empty", "", 0, 0, 1}};
    checkpoint.mesh = small_mesh();
    Vector odd(5);
    odd << 1.0 / 3, -0.0, 5e-324, std::nan("3"), 1e308;
    checkpoint.fields["pore.pressure"] = {odd, -odd};
    checkpoint.fields["a/b..c %"] = {Vector::LinSpaced(1000, 0, 1), Vector::Zero(1000)};
    checkpoint.fields["empty.field"] = {Vector(), Vector()};
    checkpoint.extra["anderson/outer"] = odd;
    checkpoint.extra["."] = Vector::Ones(1);
    checkpoint.extra["nothing"] = Vector();
  }

  std::string message_of_reading() const {
    return input_error_of([&] { read_checkpoint(path); });
  }

  Checkpoint checkpoint;
  std::filesystem::path path = folder / "checkpoint.h5";
};

TEST_F(CheckpointTest, ComesBackToTheBit) {
  write_checkpoint(path, checkpoint);
  const Checkpoint read = read_checkpoint(path);
  EXPECT_EQ(read.scene_name, checkpoint.scene_name);
  EXPECT_EQ(read.scene_fingerprint, checkpoint.scene_fingerprint);
  EXPECT_EQ(read.program_version, checkpoint.program_version);
  ASSERT_EQ(read.notes.size(), 2u);
  EXPECT_EQ(read.notes[0].topic, checkpoint.notes[0].topic);
  EXPECT_EQ(read.notes[0].text, checkpoint.notes[0].text);
  EXPECT_EQ(read.notes[0].first_time, checkpoint.notes[0].first_time);
  EXPECT_EQ(read.notes[0].last_time, checkpoint.notes[0].last_time);
  EXPECT_EQ(read.notes[0].steps, 7);
  EXPECT_EQ(read.notes[0].measure, 1e-300);
  EXPECT_TRUE(is_same_mesh(read.mesh, checkpoint.mesh));
  ASSERT_EQ(read.fields.size(), checkpoint.fields.size());
  for (const auto& [name, values] : checkpoint.fields) {
    ASSERT_TRUE(read.fields.contains(name)) << name;
    EXPECT_TRUE(same_bits(read.fields.at(name).now, values.now)) << name;
    EXPECT_TRUE(same_bits(read.fields.at(name).accepted, values.accepted)) << name;
  }
  ASSERT_EQ(read.extra.size(), checkpoint.extra.size());
  for (const auto& [name, values] : checkpoint.extra) EXPECT_TRUE(same_bits(read.extra.at(name), values)) << name;
}

TEST_F(CheckpointTest, WritingAgainReplacesItAndLeavesNoPartialFile) {
  write_checkpoint(path, checkpoint);
  checkpoint.program_version = "0.2.0";
  write_checkpoint(path, checkpoint);
  EXPECT_EQ(read_checkpoint(path).program_version, "0.2.0");
  int files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++files;
  EXPECT_EQ(files, 1);
}

TEST_F(CheckpointTest, AFailedWriteKeepsTheOldOne) {
  write_checkpoint(path, checkpoint);
  std::filesystem::create_directory(path.string() + ".partial");
  checkpoint.program_version = "0.2.0";
  EXPECT_THROW(write_checkpoint(path, checkpoint), std::runtime_error);
  EXPECT_EQ(read_checkpoint(path).program_version, "0.1.0");
}

TEST_F(CheckpointTest, AMissingFileIsNamed) {
  const std::string message = message_of_reading();
  EXPECT_THAT(message, HasSubstr(path.string()));
  EXPECT_THAT(message, HasSubstr("no such file"));
}

TEST_F(CheckpointTest, WhateverLengthItIsCutToItIsRefused) {
  write_checkpoint(path, checkpoint);
  const std::string whole = read_text(path);
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 97) {
    write_text(path, whole.substr(0, length));
    const std::string message = message_of_reading();
    EXPECT_THAT(message, HasSubstr("cut short or not an HDF5 file")) << length;
    EXPECT_THAT(message, HasSubstr("without --restart")) << length;
  }
}

TEST_F(CheckpointTest, ADamagedByteIsRefusedOrHarmless) {
  write_checkpoint(path, checkpoint);
  const std::string whole = read_text(path);
  std::mt19937 random(1);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::string damaged = whole;
    damaged[random() % damaged.size()] ^= static_cast<char>(1 + random() % 255);
    write_text(path, damaged);
    try {
      const Checkpoint read = read_checkpoint(path);  // the byte was one that no array uses
      EXPECT_TRUE(is_same_mesh(read.mesh, checkpoint.mesh));
      EXPECT_TRUE(same_bits(read.fields.at("a/b..c %").now, checkpoint.fields.at("a/b..c %").now));
      EXPECT_TRUE(same_bits(read.extra.at("anderson/outer"), checkpoint.extra.at("anderson/outer")));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

TEST_F(CheckpointTest, AnotherKindOfFileIsRefused) {
  write_text(path, "components: {}\n");
  EXPECT_THAT(message_of_reading(), HasSubstr("not an HDF5 file"));
  {
    Hdf5Writer other(path);
    other.text("something", "else");
    other.close();
  }
  EXPECT_THAT(message_of_reading(), HasSubstr("not a checkpoint"));
}

TEST_F(CheckpointTest, AnotherFormatVersionIsRefusedWithBothVersions) {
  {
    Hdf5Writer newer(path);
    newer.text("format", "sprekk checkpoint");
    newer.integers("format_version", std::array{18});
    newer.text("program_version", "9.8");
    newer.close();
  }
  const std::string message = message_of_reading();
  EXPECT_THAT(message, HasSubstr("version 18"));
  EXPECT_THAT(message, HasSubstr("sprekk 9.8"));
  EXPECT_THAT(message, HasSubstr("this program reads version 19"));
}

TEST_F(CheckpointTest, AnotherSceneIsRefused) {
  require_scene(checkpoint, path, "mandel", checkpoint.scene_fingerprint);
  const std::string other = input_error_of([&] { require_scene(checkpoint, path, "terzaghi", fingerprint("x")); });
  EXPECT_THAT(other, HasSubstr("belongs to the scene 'mandel', this one is 'terzaghi'"));
  const std::string changed = input_error_of([&] { require_scene(checkpoint, path, "mandel", fingerprint("x")); });
  EXPECT_THAT(changed, HasSubstr("'mandel' has changed"));
}

TEST_F(CheckpointTest, FingerprintIsTheFowlerNollVoHash) {
  // Test vectors of the hash's authors, draft-eastlake-fnv, appendix C.
  EXPECT_EQ(fingerprint(""), "cbf29ce484222325");
  EXPECT_EQ(fingerprint("a"), "af63dc4c8601ec8c");
  EXPECT_EQ(fingerprint("foobar"), "85944171f73967e8");
}

class CheckpointFields : public CheckpointTest {
 protected:
  static FieldSpec cell_field(const std::string& name) {
    return {.owner = "pore",
            .name = name,
            .location = Location::cell,
            .role = Role::unknown(BlockKind::interface),
            .unit = "Pa",
            .doc = ""};
  }
};

TEST_F(CheckpointFields, BothTimeLevelsAreRestored) {
  const Mesh& mesh = checkpoint.mesh;
  FieldStore store;
  store.add(mesh, cell_field("pressure")).set_both(Vector::Constant(mesh.cell_count(), 1.0 / 3));
  store.at("pore.pressure").set(Vector::LinSpaced(mesh.cell_count(), 0, 1));
  checkpoint.fields = field_values(store);
  write_checkpoint(path, checkpoint);

  FieldStore other;
  other.add(mesh, cell_field("pressure"));
  restore_fields(read_checkpoint(path), path, other);
  EXPECT_TRUE(same_bits(other.at("pore.pressure").now(), store.at("pore.pressure").now()));
  EXPECT_TRUE(same_bits(other.at("pore.pressure").accepted(), store.at("pore.pressure").accepted()));
}

TEST_F(CheckpointFields, DifferentFieldsAreRefusedByName) {
  const Mesh& mesh = checkpoint.mesh;
  FieldStore store;
  store.add(mesh, cell_field("pressure"));
  const auto message = [&] { return input_error_of([&] { restore_fields(checkpoint, path, store); }); };

  checkpoint.fields.clear();
  EXPECT_THAT(message(), HasSubstr("it has no field pore.pressure"));
  checkpoint.fields["pore.pressure"] = {Vector::Zero(3), Vector::Zero(3)};
  EXPECT_THAT(message(), HasSubstr("field pore.pressure has 3 values there and 32 here"));
  checkpoint.fields["pore.pressure"] = {Vector::Ones(32), Vector::Ones(32)};
  checkpoint.fields["pore.more"] = {};
  EXPECT_THAT(message(), HasSubstr("it has a field pore.more that this run lacks"));
  EXPECT_EQ(store.at("pore.pressure").now(), Vector::Zero(32));
}

}  // namespace
}  // namespace sprekk
