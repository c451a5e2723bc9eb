// Arrays that stand in a file as text, read ahead by several threads: the same values, and of what
// is wrong the same sentence, in whatever order they are asked for.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <random>
#include <thread>

#include "slow_run.h"
#include "status.h"
#include "strange_workers.h"
#include "values.h"

namespace tetstream {
namespace {

using namespace test;

const size_t kValues = slowRun() ? 6000 : 20000;

// Bytes of which is known how far they were read; from some place on they cannot be.
class WatchedBytes final : public ByteSource {
 public:
  explicit WatchedBytes(const std::string& text, uint64_t fails_at = UINT64_MAX)
      : ByteSource("memory"), text_(text), fails_at_(fails_at) {}
  size_t read(void*, size_t) override { return 0; }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    const size_t n = std::min<size_t>(size, text_.size() - static_cast<size_t>(offset));
    if (offset + n > fails_at_) fail(Status::kIo, "memory: the disk is broken");
    std::memcpy(out, text_.data() + offset, n);
    read_ = std::max<uint64_t>(read_, offset + n);
    return n;
  }
  bool seekable() const override { return true; }
  uint64_t size() const override { return text_.size(); }
  uint64_t wasRead() const { return read_; }

 private:
  const std::string& text_;
  uint64_t fails_at_, read_ = 0;
};

struct Portion {
  uint64_t first;
  size_t count;
};

std::vector<Portion> inSequence(size_t values, size_t count) {
  std::vector<Portion> all;
  for (size_t at = 0; at < values; at += count) all.push_back({at, std::min(count, values - at)});
  return all;
}

// The bytes of the portions, and the first error.
template <class Out>
std::string outcomeOf(ByteSource& bytes, ValueType type, ScalarType wanted,
                      const std::vector<Portion>& portions, size_t values,
                      const Helpers& helpers = {}) {
  std::string all;
  try {
    const auto opened = openTextValues(bytes, "numbers", type, {0, bytes.size(), values}, helpers);
    for (const Portion& portion : portions) {
      std::vector<Out> out(portion.count);
      opened->read(portion.first, portion.count, out.data(), wanted);
      all.append(reinterpret_cast<const char*>(out.data()), out.size() * sizeof(Out));
    }
  } catch (const Error& error) {
    all += error.text();
  }
  return all;
}

class ValueThreads : public testing::Test {
 protected:
  Helpers help(size_t piece_bytes) const {
    return {{&tasks_, piece_bytes}, std::this_thread::get_id()};
  }
  template <class Out>
  std::string expectSame(const std::string& text, ValueType type, ScalarType wanted,
                         const std::vector<Portion>& portions, size_t values) {
    WatchedBytes bytes(text);
    const std::string alone = outcomeOf<Out>(bytes, type, wanted, portions, values);
    for (const size_t piece : {40, 1000, 64 << 10})
      EXPECT_TRUE(outcomeOf<Out>(bytes, type, wanted, portions, values, help(piece)) == alone)
          << piece << " bytes, "
          << outcomeOf<Out>(bytes, type, wanted, portions, values, help(piece)).substr(0, 300)
          << " and not " << alone.substr(0, 300);
    return alone;
  }
  std::mt19937_64 random_{3};

 private:
  const Tasks tasks_{3};
};

std::string realText(size_t count, std::mt19937_64& random) {
  const char* const forms[] = {"%.9g", "%.17g", "%.4e", "%.25f", "%+.3f", "%.3g"};
  std::string text;
  for (size_t i = 0; i < count; ++i) {
    const double value = std::ldexp(static_cast<double>(random() % 100000), -10);
    text += textOf(forms[random() % std::size(forms)], i % 9 ? value : value * 1e-60) +
            (i % 7 == 6 ? " \r\n" : " ");
  }
  return text;
}

std::string integerText(size_t count, std::mt19937_64& random) {
  std::string text;
  for (size_t i = 0; i < count; ++i)
    text += (i % 11 == 3   ? "-"
             : i % 13 == 5 ? "+"
                           : "") +
            std::to_string(random() >> (33 + i % 31)) + (i % 7 == 6 ? "\n" : " ");
  return text;
}

TEST_F(ValueThreads, GiveTheValuesOfOneThread) {
  const std::string reals = realText(kValues, random_), integers = integerText(kValues, random_);
  for (const size_t portion : {1000, 15000}) {
    const std::vector<Portion> portions = inSequence(kValues, portion);
    expectSame<float>(reals, ValueType::kFloat32, ScalarType::kFloat32, portions, kValues);
    expectSame<double>(reals, ValueType::kFloat64, ScalarType::kFloat64, portions, kValues);
    expectSame<double>(reals, ValueType::kFloat32, ScalarType::kFloat64, portions, kValues);
    expectSame<int32_t>(integers, ValueType::kInt32, ScalarType::kInt32, portions, kValues);
    expectSame<int64_t>(integers, ValueType::kInt64, ScalarType::kInt64, portions, kValues);
    expectSame<double>(integers, ValueType::kInt64, ScalarType::kFloat64, portions, kValues);
    EXPECT_EQ(
        expectSame<int64_t>(integers, ValueType::kUInt64, ScalarType::kInt64, portions, kValues)
                .find("is no number") == std::string::npos,
        false);
  }
}

TEST_F(ValueThreads, ComeInAnyOrder) {
  const std::string text = realText(kValues, random_);
  std::vector<Portion> portions;
  uint64_t at = 0;
  for (int leap = 0; leap < 12; ++leap) {
    for (int i = 0; i < 25 && at < kValues; ++i) {
      const size_t count = std::min<size_t>(1 + random_() % 1500, kValues - at);
      portions.push_back({at, count});
      at += count;
    }
    at = leap % 3 == 0   ? 0
         : leap % 3 == 1 ? std::min<uint64_t>(at + 700, kValues - 1)
                         : random_() % kValues;
  }
  expectSame<double>(text, ValueType::kFloat64, ScalarType::kFloat64, portions, kValues);
}

TEST_F(ValueThreads, SayWhatIsWrongAsOneThreadDoes) {
  const std::string text = integerText(2000, random_);
  const std::vector<Portion> portions = inSequence(2000, 300);
  const std::string strange[] = {"x",
                                 "1.5",
                                 "2147483648",
                                 "99999999999999999999",
                                 "--1",
                                 "1e-400",
                                 std::string(600, '1'),
                                 std::string("1\0 2", 4),
                                 "+",
                                 "7 7",
                                 ""};
  for (const std::string& word : strange)
    for (int i = 0; i < 2; ++i) {
      std::string damaged = text;
      const size_t blank = text.find(' ', random_() % (text.size() - 20));
      damaged.replace(blank + 1, text.find_first_of(" \n", blank + 1) - blank - 1, word);
      SCOPED_TRACE(word.substr(0, 20));
      const std::string said =
          expectSame<int32_t>(damaged, ValueType::kInt32, ScalarType::kInt32, portions, 2000);
      EXPECT_NE(said.find("numbers: byte"), said.npos);
      EXPECT_EQ(word == "2147483648",
                said.find("\"2147483648\" is no number of the array's type") != said.npos);
      expectSame<double>(damaged, ValueType::kFloat64, ScalarType::kFloat64, portions, 2000);
    }
}

TEST_F(ValueThreads, EndWhereOneThreadDoes) {
  const std::string text = integerText(2000, random_);
  for (const size_t values : {1, 1999, 2000, 2001, 3000}) {
    const std::vector<Portion> portions = inSequence(values, 300);
    expectSame<double>(text, ValueType::kFloat64, ScalarType::kFloat64, portions, values);
    expectSame<double>(text + std::string(5000, ' ') + "x", ValueType::kFloat64,
                       ScalarType::kFloat64, portions, values);
    expectSame<double>(std::string(5000, '\n') + text + std::string(5000, ' '), ValueType::kFloat64,
                       ScalarType::kFloat64, portions, values);
    expectSame<double>(text.substr(0, text.size() - 1), ValueType::kFloat64, ScalarType::kFloat64,
                       portions, values);
  }
}

// Which values come before depends on how much is read at a time.
TEST_F(ValueThreads, SayThatReadingFailed) {
  const std::string text = integerText(20000, random_);
  const std::vector<Portion> portions = inSequence(20000, 500);
  for (const uint64_t fails_at : {100, 70000, 100001})
    for (const size_t piece : {40, 1000, 64 << 10}) {
      WatchedBytes bytes(text, fails_at);
      EXPECT_TRUE(outcomeOf<double>(bytes, ValueType::kFloat64, ScalarType::kFloat64, portions,
                                    20000, help(piece))
                      .ends_with("memory: the disk is broken"));
    }
}

TEST_F(ValueThreads, ReadSomePiecesAheadAndNoMore) {
  const std::string text = integerText(kValues, random_);
  constexpr size_t kPiece = 1000;
  WatchedBytes bytes(text);
  const auto values =
      openTextValues(bytes, "numbers", ValueType::kInt64, {0, text.size(), kValues}, help(kPiece));
  EXPECT_EQ(bytes.wasRead(), 0U);
  int64_t some[100];
  size_t place = 0;
  for (size_t at = 0; at < kValues; at += 100) {
    values->read(at, 100, some, ScalarType::kInt64);
    for (int i = 0; i < 100; ++i) place = text.find_first_of(" \n", place) + 1;
    ASSERT_LE(bytes.wasRead(), place + 7 * kPiece);
  }
}

// Only the thread that they help may ask for it.
TEST_F(ValueThreads, AreNotAskedByAThreadThatTheyDoNotHelp) {
  const std::string text = integerText(kValues, random_);
  WatchedBytes bytes(text);
  NoWorkers none;
  const Tasks tasks(3, &none);
  const Helpers helpers = {{&tasks, 1000}, std::this_thread::get_id()};
  const std::vector<Portion> portions = inSequence(kValues, 1000);
  const auto read = [&] {
    return outcomeOf<double>(bytes, ValueType::kFloat64, ScalarType::kFloat64, portions, kValues,
                             helpers);
  };
  std::string there;
  std::thread([&] { there = read(); }).join();
  EXPECT_EQ(none.refused, 0U);
  EXPECT_TRUE(there == read());
  EXPECT_GT(none.refused, 0U);
  const auto values =
      openTextValues(bytes, "numbers", ValueType::kFloat64, {0, text.size(), kValues}, helpers);
  double some[100];
  values->read(0, 100, some, ScalarType::kFloat64);  // begins to read ahead
  const size_t refused = none.refused;
  std::thread([&] {
    for (size_t at = 100; at < kValues; at += 100)
      values->read(at, 100, some, ScalarType::kFloat64);
  }).join();
  EXPECT_EQ(none.refused, refused);
}

}  // namespace
}  // namespace tetstream
