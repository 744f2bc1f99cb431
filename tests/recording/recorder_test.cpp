// SPDX-License-Identifier: Apache-2.0
#include <articula/recording/record_stream.hpp>
#include <articula/recording/recorder.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <vector>

#include "catch.hpp"

using namespace articula;

namespace {

template <class AnyRecorder>
std::vector<int> content(const AnyRecorder& recorder) {
  std::vector<int> records;
  recorder.for_each([&](int record) { records.push_back(record); });
  return records;
}

}  // namespace

TEST_CASE("a recorder keeps the last records, the oldest first") {
  Recorder<int, 4> recorder;
  CHECK(content(recorder).empty());
  for (int k = 1; k <= 3; ++k) recorder.add(k);
  CHECK(content(recorder) == std::vector<int>{1, 2, 3});
  for (int k = 4; k <= 10; ++k) recorder.add(k);
  CHECK(content(recorder) == std::vector<int>{7, 8, 9, 10});
  CHECK_FALSE(recorder.frozen());
}

TEST_CASE("a trigger freezes it after some records more, until it is let go on") {
  Recorder<int, 5> recorder(2);
  for (int k = 1; k <= 10; ++k) recorder.add(k, k == 8);
  CHECK(recorder.frozen());
  CHECK(content(recorder) == std::vector<int>{6, 7, 8, 9, 10});
  for (int k = 11; k <= 13; ++k) recorder.add(k, true);
  CHECK(recorder.missed() == 3);
  CHECK(content(recorder) == std::vector<int>{6, 7, 8, 9, 10});
  recorder.resume();
  recorder.add(14);
  CHECK(content(recorder) == std::vector<int>{14});
  CHECK_FALSE(recorder.frozen());
}

TEST_CASE("triggers that follow one another count as one") {
  Recorder<int, 5> recorder(2);
  for (int k = 1; k <= 9; ++k) recorder.add(k, k >= 5);
  CHECK(content(recorder) == std::vector<int>{3, 4, 5, 6, 7});
  CHECK(recorder.missed() == 2);
}

TEST_CASE("the record of the trigger is there, however many are to follow") {
  Recorder<int, 3> recorder(100);
  for (int k = 1; k <= 10; ++k) recorder.add(k, k == 4);
  CHECK(content(recorder) == std::vector<int>{4, 5, 6});
}

TEST_CASE("another thread triggers, reads in peace and lets it go on") {
  Recorder<int, 64> recorder(8);
  std::atomic<bool> done = false;
  std::thread loop([&] {
    for (int k = 0; !done; ++k) recorder.add(k);
  });
  bool in_order = true;
  for (int dump = 0; dump < 50; ++dump) {
    recorder.trigger();
    while (!recorder.frozen()) std::this_thread::yield();
    int last = -1;
    recorder.for_each([&](int record) {
      in_order = in_order && (last < 0 || record == last + 1);
      last = record;
    });
    in_order = in_order && last >= 0;
    recorder.resume();
  }
  done = true;
  loop.join();
  CHECK(in_order);
}

TEST_CASE("a stream hands on all that it took, in order, to all sinks") {
  std::vector<int> first, second;
  RecordStream<int, 1024> stream({[&](int record) { first.push_back(record); },
                                  [&](int record) { second.push_back(record); }});
  std::uint64_t accepted = 0;
  for (int k = 0; k < 5000; ++k) {
    accepted += stream.push(k) ? 1U : 0U;
    if (k % 500 == 0) std::this_thread::yield();
  }
  stream.close();
  CHECK(first.size() == accepted);
  CHECK(first == second);
  CHECK(std::is_sorted(first.begin(), first.end()));
  CHECK(stream.dropped() == 5000 - accepted);
}

TEST_CASE("a stream takes writers as they are") {
  struct Writer {
    using Record = int;
    void write(int record) { records.push_back(record); }
    std::vector<int> records;
  };
  Writer first, second;
  RecordStream stream(first, second);
  for (int k = 0; k < 10; ++k) stream.push(k);
  stream.close();
  CHECK(first.records == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(second.records == first.records);
}

TEST_CASE("a sink that fails is heard of, and the others go on") {
  int count = 0;
  RecordStream<int, 64> stream({[](int record) {
                                  if (record == 3) throw std::runtime_error("disk full");
                                },
                                [&](int) { ++count; }});
  for (int k = 0; k < 10; ++k) stream.push(k);
  CHECK_THROWS_WITH(stream.close(), "disk full");
  CHECK(count == 10);
  stream.close();  // told once
}
