// Datasets of HDF5 in every layout, filter and byte order that we read, made by libhdf5 itself, and
// some that lie.
#include <gtest/gtest.h>

#include <functional>
#include <numeric>

#include "hdf5_bytes.h"
#include "hdf5_filters.h"
#include "hdf5_testing.h"

namespace tetstream {
namespace {

using namespace test;

constexpr hsize_t kDatasetRows = 1000, kDatasetColumns = 3;

struct Kind {
  const char* name;
  std::function<void(const Hdf5Library&, hid_t plan)> plan;
  const char* type = "H5T_NATIVE_INT_g";  // as it is stored
};

std::vector<int64_t> numbers() {
  std::vector<int64_t> all(kDatasetRows * kDatasetColumns);
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int64_t>(i * i % 7919) - 4000;
  return all;
}

void chunks(const Hdf5Library& h, hid_t plan, hsize_t rows, hsize_t columns) {
  const hsize_t chunk[2] = {rows, columns};
  ASSERT_GE(h.call<herr_t(hid_t, int, const hsize_t*)>("H5Pset_chunk")(plan, 2, chunk), 0);
}
void filter(const Hdf5Library& h, hid_t plan, const char* setter) {
  ASSERT_GE(h.call<herr_t(hid_t)>(setter)(plan), 0);
}
void deflate(const Hdf5Library& h, hid_t plan) {
  ASSERT_GE(h.call<herr_t(hid_t, unsigned)>("H5Pset_deflate")(plan, 6), 0);
}

// A file with the dataset "a" of `numbers()`.
std::string makeDataset(const Kind& kind) {
  std::string bytes;
  Hdf5File file(std::make_unique<MemoryStorage>(bytes), "made", true);
  {
    const Hdf5Turn turn;
    const Hdf5Library h;
    const Hdf5Id plan(hdf5().Pcreate(hdf5().P_CLS_DATASET_CREATE_ID), hdf5().Pclose);
    kind.plan(h, plan);
    const hsize_t sizes[2] = {kDatasetRows, kDatasetColumns};
    const Hdf5Id space(hdf5().Screate_simple(2, sizes, nullptr), hdf5().Sclose);
    const Hdf5Id set = file.create("a", h.number(kind.type), space, plan);
    EXPECT_GE(
        hdf5().Dwrite(set, hdf5().T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers().data()),
        0);
  }
  file.close();
  return bytes;
}

std::shared_ptr<Hdf5File> open(const std::string& bytes) {
  return openHdf5(openMemory(bytes.data(), bytes.size(), "made"));
}

std::vector<int64_t> readWhole(const std::string& bytes) {
  std::vector<int64_t> all(kDatasetRows * kDatasetColumns);
  openHdf5Values(open(bytes), "a", 0)->read(0, all.size(), all.data(), ScalarType::kInt64);
  return all;
}

std::string refusal(const std::string& bytes) {
  try {
    readWhole(bytes);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

const Kind kKinds[] = {
    {"contiguous", [](const Hdf5Library&, hid_t) {}},
    {"contiguous, big-endian", [](const Hdf5Library&, hid_t) {}, "H5T_STD_I64BE_g"},
    {"compact",
     [](const Hdf5Library& h, hid_t plan) {
       h.call<herr_t(hid_t, H5D_layout_t)>("H5Pset_layout")(plan, H5D_COMPACT);
     },
     "H5T_STD_I16LE_g"},
    {"whole rows", [](const Hdf5Library& h, hid_t plan) { chunks(h, plan, 64, kDatasetColumns); }},
    {"some columns", [](const Hdf5Library& h, hid_t plan) { chunks(h, plan, 129, 2); }},
    {"one chunk",
     [](const Hdf5Library& h, hid_t plan) { chunks(h, plan, kDatasetRows, kDatasetColumns); }},
    {"deflate",
     [](const Hdf5Library& h, hid_t plan) {
       chunks(h, plan, 100, 3);
       deflate(h, plan);
     }},
    {"shuffle, deflate, big-endian",
     [](const Hdf5Library& h, hid_t plan) {
       chunks(h, plan, 100, 1);
       filter(h, plan, "H5Pset_shuffle");
       deflate(h, plan);
     },
     "H5T_STD_I32BE_g"},
    {"fletcher32 of bytes in odd number",
     [](const Hdf5Library& h, hid_t plan) {
       chunks(h, plan, 333, 3);
       filter(h, plan, "H5Pset_fletcher32");
     },
     "H5T_STD_I16LE_g"},
    {"fletcher32, shuffle, deflate",
     [](const Hdf5Library& h, hid_t plan) {
       chunks(h, plan, 501, 2);
       filter(h, plan, "H5Pset_fletcher32");
       filter(h, plan, "H5Pset_shuffle");
       deflate(h, plan);
     }},
};

TEST(Hdf5Bytes, ReadsWhatTheLibraryWrote) {
  for (const Kind& kind : kKinds) {
    const std::string bytes = makeDataset(kind);
    const std::vector<int64_t> expected = numbers();
    for (const size_t step : {size_t{7}, size_t{1000}, expected.size()}) {
      const auto values = openHdf5Values(open(bytes), "a", 0);
      std::vector<int64_t> all(expected.size());
      for (size_t at = 0; at < all.size(); at += step)
        values->read(at, std::min(step, all.size() - at), all.data() + at, ScalarType::kInt64);
      EXPECT_EQ(all, expected) << kind.name << " by " << step;
    }
    const auto values = openHdf5Values(open(bytes), "a", 100);
    int64_t one = 0;
    values->read(5, 1, &one, ScalarType::kInt64);
    EXPECT_EQ(one, expected[105]) << kind.name;
  }
}

TEST(Hdf5Bytes, FillsChunksThatWereNeverWritten) {
  std::string bytes;
  {
    Hdf5File file(std::make_unique<MemoryStorage>(bytes), "made", true);
    {
      const Hdf5Turn turn;
      const Hdf5Library h;
      const Hdf5Id plan(hdf5().Pcreate(hdf5().P_CLS_DATASET_CREATE_ID), hdf5().Pclose);
      chunks(h, plan, 10, kDatasetColumns);
      const int32_t fill = -5;
      h.call<herr_t(hid_t, hid_t, const void*)>("H5Pset_fill_value")(plan, hdf5().T_NATIVE_INT32,
                                                                     &fill);
      const hsize_t sizes[2] = {kDatasetRows, kDatasetColumns}, start[2] = {500, 0},
                    some[2] = {20, kDatasetColumns};
      const Hdf5Id space(hdf5().Screate_simple(2, sizes, nullptr), hdf5().Sclose);
      const Hdf5Id part(hdf5().Screate_simple(2, some, nullptr), hdf5().Sclose);
      hdf5().Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, some, nullptr);
      const Hdf5Id set = file.create("a", hdf5().T_NATIVE_INT32, space, plan);
      const std::vector<int64_t> ones(20 * kDatasetColumns, 1);
      hdf5().Dwrite(set, hdf5().T_NATIVE_INT64, part, space, H5P_DEFAULT, ones.data());
    }
    file.close();
  }
  std::vector<int64_t> expected(kDatasetRows * kDatasetColumns, -5);
  std::fill_n(expected.begin() + 500 * kDatasetColumns, 20 * kDatasetColumns, 1);
  EXPECT_EQ(readWhole(bytes), expected);
}

TEST(Hdf5Bytes, NamesTheChunkThatIsDamaged) {
  for (const size_t kind : {6, 8}) {  // deflate, fletcher32
    std::string bytes = makeDataset(kKinds[kind]);
    // Most of the file is chunks; in the middle there is nothing else.
    for (size_t i = 0; i < 16; ++i) bytes[bytes.size() / 2 + i] ^= 0x55;
    EXPECT_NE(refusal(bytes).find("made: dataset \"a\": the chunk of row "), std::string::npos)
        << kKinds[kind].name << ": " << refusal(bytes);
  }
}

TEST(Hdf5Bytes, RefusesFiltersThatItCannotUndo) {
  const std::string bytes = makeDataset({"scale and offset", [](const Hdf5Library& h, hid_t plan) {
                                           chunks(h, plan, 100, 3);
                                           filter(h, plan, "H5Pset_nbit");
                                         }});
  EXPECT_EQ(refusal(bytes),
            "made: dataset \"a\" has HDF5's filter 5 (\"nbit\"); deflate, shuffle and fletcher32 "
            "are read");
}

// Those behind the second are one with it.
TEST(Hdf5Bytes, ReadsDatasetsOfMoreDirections) {
  constexpr hsize_t sizes[4] = {20, 25, 3, 2};
  const auto make = [&](const std::vector<hsize_t>& chunk) {
    std::string bytes;
    Hdf5File file(std::make_unique<MemoryStorage>(bytes), "made", true);
    {
      const Hdf5Turn turn;
      const Hdf5Library h;
      const Hdf5Id plan(hdf5().Pcreate(hdf5().P_CLS_DATASET_CREATE_ID), hdf5().Pclose);
      if (!chunk.empty()) {
        h.call<herr_t(hid_t, int, const hsize_t*)>("H5Pset_chunk")(plan, 4, chunk.data());
        deflate(h, plan);
      }
      const Hdf5Id space(hdf5().Screate_simple(4, sizes, nullptr), hdf5().Sclose);
      const Hdf5Id set = file.create("a", hdf5().T_NATIVE_INT64, space, plan);
      EXPECT_GE(hdf5().Dwrite(set, hdf5().T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT,
                              numbers().data()),
                0);
    }
    file.close();
    return bytes;
  };
  const std::vector<hsize_t> chunks[] = {{}, {1, 25, 3, 2}, {7, 25, 3, 2}, {7, 4, 3, 2}};
  for (const std::vector<hsize_t>& chunk : chunks)
    EXPECT_EQ(readWhole(make(chunk)), numbers()) << chunk.size();
  EXPECT_NE(refusal(make({1, 25, 3, 1})).find("chunks that are cut in the third direction"),
            std::string::npos);
}

// What the head of the chunks says of the size of an element is not what the type says: libhdf5
// makes room for the one and copies the other.
TEST(Hdf5Bytes, DoesNotBelieveTheHeadOfTheChunks) {
  std::string bytes = makeDataset(kKinds[3]);
  const std::string head("\x40\0\0\0\x03\0\0\0\x04\0\0\0", 12);  // rows, columns, element
  size_t changed = 0;
  for (size_t at = bytes.find(head); at != std::string::npos; at = bytes.find(head, at + 1)) {
    bytes[at + 8] = 1;
    ++changed;
  }
  ASSERT_GE(changed, 1u);
  EXPECT_EQ(readWhole(bytes), numbers());
}

// Found by the fuzzer: every byte of an element was counted, although there was no element. A
// thousand times that were half an hour.
TEST(Hdf5Bytes, ElementsThatAreLargerThanTheirChunkTakeNoTime) {
  const Hdf5Chunk chunk = {1, 2, 3, 4, 5, 6};
  for (int i = 0; i < 1000; ++i) {
    Hdf5Chunk same = chunk;
    EXPECT_TRUE(unshuffleChunk(same, 0xffffffff));
    EXPECT_EQ(same, chunk);
  }
  Hdf5Chunk pairs = {1, 2, 3, 4, 5, 6, 7};
  EXPECT_TRUE(unshuffleChunk(pairs, 2));
  EXPECT_EQ(pairs, (Hdf5Chunk{1, 4, 2, 5, 3, 6, 7}));
}

}  // namespace
}  // namespace tetstream
