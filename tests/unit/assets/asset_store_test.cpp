#include "client-sdk/assets/asset_store.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client-sdk/assets/mesh_files.hpp"
#include "server/base/clock.hpp"
#include "server/content/content_hash.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_http_server.hpp"

namespace mechane::assets {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using test::HttpReply;
using test::is_error;
using test::SmallHttpServer;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string hash_of(const std::string& text) {
  return content::content_hash(std::as_bytes(std::span(text)));
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class AssetStoreTest : public testing::Test {
 protected:
  AssetStoreTest() {
    ::setenv("no_proxy", "127.0.0.1", 1);
    options_.cache_folder = top_ / "cache";
    options_.first_retry = milliseconds(20);
    options_.longest_retry = milliseconds(80);
  }
  void TearDown() override {
    store_.reset();
    std::error_code ignored;
    fs::permissions(top_ / "cache", fs::perms::owner_all, ignored);
  }
  void open(const SmallHttpServer& server) { open(server.address("/screw")); }
  void open(const std::string& address) {
    store_.reset();
    store_ = std::move(*AssetStore::open(*AssetAddress::parse(address), options_));
  }
  /// Waits until the file is in this state; if amiss, by this fault.
  AssetFile wait_for(const std::string& name, const std::string& hash, AssetState state,
                     std::optional<ErrorCode> code = {}) {
    SystemClock clock;
    const TimePoint end = clock.now() + std::chrono::seconds(20);
    AssetFile file = store_->find(name, hash);
    while (clock.now() < end && (file.state != state || (code && file.error.code != *code))) {
      clock.sleep_until(clock.now() + milliseconds(2));  // sleeps: between two looks
      file = store_->find(name, hash);
    }
    EXPECT_EQ(file.state, state) << file.error.to_string();
    if (code) {
      EXPECT_THAT(file.error, is_error(*code, 0));
    }
    return file;
  }
  /// A file of the cache, by content.
  [[nodiscard]] fs::path cached(const std::string& hash, const std::string& extension = ".glb") const {
    return options_.cache_folder / "files" / hash.substr(0, 2) / (hash + extension);
  }

  test::ScratchFolder scratch_;
  fs::path top_ = scratch_.path();
  AssetStoreOptions options_;
  std::shared_ptr<AssetStore> store_;
  const std::string body_ = std::string(40'000, 'm') + "esh";
  const std::string hash_ = hash_of(body_);
};

TEST_F(AssetStoreTest, the_right_file_comes_once_and_stays) {
  auto server = std::make_unique<SmallHttpServer>([&](const std::string&, const std::string&) {
    return HttpReply{200, body_};
  });
  open(*server);
  EXPECT_EQ(store_->find("../models/a.glb", hash_).state, AssetState::on_its_way) << "the caller never waits";
  const AssetFile file = wait_for("../models/a.glb", hash_, AssetState::here);
  EXPECT_EQ(text_of(file.file), body_);
  EXPECT_EQ(file.file, cached(hash_));
  EXPECT_THAT(store_->take_arrived(), ElementsAre("../models/a.glb"));
  EXPECT_THAT(store_->take_arrived(), testing::IsEmpty());
  EXPECT_EQ(server->asked("/models/a.glb"), 1);
  // Another visit: from the disk, with no server at all.
  const std::string address = server->address("/screw");
  server.reset();
  open(address);
  EXPECT_EQ(text_of(wait_for("../models/a.glb", hash_, AssetState::here).file), body_);
}

TEST_F(AssetStoreTest, what_may_yet_come_is_awaited_with_patience) {
  constexpr std::chrono::minutes kLong(5);
  std::atomic<bool> there{false};
  const SmallHttpServer server([&](const std::string&, const std::string&) {
    return HttpReply{there ? 200 : 404, body_};
  });
  open(server);
  EXPECT_FALSE(store_->is_awaited(kLong)) << "nothing was asked for";
  EXPECT_EQ(store_->find("../../never.glb", hash_).state, AssetState::amiss);
  EXPECT_FALSE(store_->is_awaited(kLong)) << "no name of ours: it will never come";
  (void)store_->find("a.glb", hash_);
  EXPECT_TRUE(store_->is_awaited(kLong));
  wait_for("a.glb", hash_, AssetState::amiss);
  EXPECT_TRUE(store_->is_awaited(kLong)) << "it is asked for again";
  EXPECT_FALSE(store_->is_awaited(milliseconds(0)));
  there = true;
  wait_for("a.glb", hash_, AssetState::here);
  EXPECT_FALSE(store_->is_awaited(kLong));
}

TEST_F(AssetStoreTest, wrong_bytes_are_not_used_and_are_asked_for_again) {
  std::atomic<bool> right{false};
  const SmallHttpServer server([&](const std::string&, const std::string&) {
    return HttpReply{200, right ? body_ : "another model"};
  });
  open(server);
  const AssetFile wrong = wait_for("a.glb", hash_, AssetState::amiss, ErrorCode::conflict);
  EXPECT_THAT(wrong.error.what, HasSubstr(hash_.substr(0, 8)));
  EXPECT_FALSE(fs::exists(options_.cache_folder / "files")) << "nothing wrong comes into the cache";
  right = true;
  wait_for("a.glb", hash_, AssetState::here);
  EXPECT_GE(server.asked("/screw/a.glb"), 2);
}

TEST_F(AssetStoreTest, what_a_server_has_not_is_asked_for_more_and_more_rarely) {
  std::mutex mutex;
  std::vector<TimePoint> times;
  SystemClock clock;
  const SmallHttpServer server([&](const std::string&, const std::string&) {
    const std::lock_guard lock(mutex);
    times.push_back(clock.now());
    return HttpReply{times.size() < 4 ? 404 : 200, body_};
  });
  open(server);
  wait_for("a.glb", hash_, AssetState::amiss, ErrorCode::not_found);
  wait_for("a.glb", hash_, AssetState::here);
  ASSERT_EQ(times.size(), 4U);
  for (int i = 0; i < 3; ++i)
    EXPECT_GE(times[i + 1] - times[i], milliseconds(20) * (1 << i) - milliseconds(5)) << i;
}

TEST_F(AssetStoreTest, a_server_that_is_down_is_found_when_it_is_up) {
  const HttpReply reply{200, body_};
  const auto answer = [&](const std::string&, const std::string&) { return reply; };
  auto before = std::make_unique<SmallHttpServer>(answer);
  const std::uint16_t port = before->port();
  const std::string address = before->address("/screw");
  before.reset();
  open(address);
  wait_for("a.glb", hash_, AssetState::amiss);
  const SmallHttpServer after(answer, port);
  ASSERT_TRUE(after.bound());
  wait_for("a.glb", hash_, AssetState::here);
}

TEST_F(AssetStoreTest, a_connection_that_breaks_half_way_gives_nothing) {
  std::atomic<bool> whole{false};
  const SmallHttpServer server([&](const std::string&, const std::string&) {
    HttpReply reply{200, body_};
    if (!whole) reply.cut_at = body_.size() / 2;
    return reply;
  });
  open(server);
  wait_for("a.glb", hash_, AssetState::amiss);
  EXPECT_FALSE(fs::exists(cached(hash_)));
  wait_for("audio.wav", "", AssetState::amiss);
  whole = true;
  wait_for("a.glb", hash_, AssetState::here);
  wait_for("audio.wav", "", AssetState::here);
}

TEST_F(AssetStoreTest, a_server_that_stalls_is_given_up_and_holds_nobody_else) {
  options_.http.stall = std::chrono::seconds(1);
  const SmallHttpServer server([&](const std::string& path, const std::string&) {
    HttpReply reply{200, body_};
    reply.stall = path == "/screw/slow.glb";
    if (reply.stall) reply.cut_at = 10;
    return reply;
  });
  open(server);
  EXPECT_EQ(store_->find("slow.glb", std::string(32, 'a')).state, AssetState::on_its_way);
  wait_for("a.glb", hash_, AssetState::here);
  EXPECT_EQ(store_->find("slow.glb", std::string(32, 'a')).state, AssetState::on_its_way) << "beside it, not after it";
  wait_for("slow.glb", std::string(32, 'a'), AssetState::amiss, ErrorCode::timed_out);
}

TEST_F(AssetStoreTest, the_end_does_not_wait_for_a_server) {
  const SmallHttpServer server([&](const std::string&, const std::string&) {
    HttpReply reply{200, body_};
    reply.cut_at = 10;
    reply.stall = true;
    return reply;
  });
  open(server);
  (void)store_->find("a.glb", hash_);
  SystemClock clock;
  const TimePoint end = clock.now() + std::chrono::seconds(10);
  while (server.asked("/screw/a.glb") == 0 && clock.now() < end)
    clock.sleep_until(clock.now() + milliseconds(2));  // sleeps: between two looks
  const TimePoint began = clock.now();
  store_.reset();
  EXPECT_LT(clock.now() - began, std::chrono::seconds(3));
}

TEST_F(AssetStoreTest, a_huge_file_is_not_taken_whether_it_says_so_or_not) {
  options_.http.bytes = 10'000;
  const SmallHttpServer server([&](const std::string& path, const std::string&) {
    HttpReply reply{200, body_};
    reply.says_length = path != "/screw/silent.glb";
    if (path == "/screw/liar.glb") reply.said_length = 1'000'000'000'000;
    return reply;
  });
  open(server);
  for (const char* name : {"a.glb", "silent.glb", "liar.glb"})
    EXPECT_THAT(wait_for(name, hash_, AssetState::amiss, ErrorCode::too_large).error.what, HasSubstr("10000 bytes"));
}

TEST_F(AssetStoreTest, redirects_end_and_lead_nowhere_but_to_http) {
  const SmallHttpServer server([&](const std::string& path, const std::string&) {
    if (path == "/screw/round.glb") return HttpReply{302, "", "Location: /screw/round.glb\r\n"};
    if (path == "/screw/file.glb") return HttpReply{302, "", "Location: file:///etc/hostname\r\n"};
    if (path == "/screw/moved.glb") return HttpReply{301, "", "Location: /elsewhere/a.glb\r\n"};
    return HttpReply{200, body_};
  });
  open(server);
  wait_for("round.glb", hash_, AssetState::amiss, ErrorCode::io_failure);
  wait_for("file.glb", hash_, AssetState::amiss);
  wait_for("moved.glb", hash_, AssetState::here);
}

TEST_F(AssetStoreTest, a_name_that_leads_out_is_never_asked_for) {
  const SmallHttpServer server([&](const std::string&, const std::string&) { return HttpReply{200, body_}; });
  open(server);
  EXPECT_EQ(store_->find("../../secret.glb", hash_).state, AssetState::amiss);
  EXPECT_EQ(store_->find("a.glb", "../../../etc").state, AssetState::amiss);
  wait_for("b.glb", hash_, AssetState::here);
  EXPECT_EQ(server.asked("/secret.glb") + server.asked("/screw/a.glb"), 0);
}

TEST_F(AssetStoreTest, a_file_damaged_on_disk_is_found_and_fetched_anew) {
  const SmallHttpServer server([&](const std::string&, const std::string&) { return HttpReply{200, body_}; });
  open(server);
  wait_for("a.glb", hash_, AssetState::here);
  std::fstream(cached(hash_), std::ios::in | std::ios::out | std::ios::binary) << "X";
  open(server);
  EXPECT_EQ(text_of(wait_for("a.glb", hash_, AssetState::here).file), body_);
  EXPECT_EQ(server.asked("/screw/a.glb"), 2);
}

TEST_F(AssetStoreTest, a_file_that_another_display_removed_is_fetched_anew) {
  const SmallHttpServer server([&](const std::string&, const std::string&) { return HttpReply{200, body_}; });
  open(server);
  wait_for("a.glb", hash_, AssetState::here);
  fs::remove(cached(hash_));
  EXPECT_EQ(store_->find("a.glb", hash_).state, AssetState::on_its_way);
  EXPECT_EQ(text_of(wait_for("a.glb", hash_, AssetState::here).file), body_);
  EXPECT_EQ(server.asked("/screw/a.glb"), 2);
}

TEST_F(AssetStoreTest, without_a_hash_the_server_is_asked_whether_its_file_is_still_the_same) {
  std::atomic<int> version{1};
  auto server = std::make_unique<SmallHttpServer>([&](const std::string&, const std::string& head) {
    const std::string etag = fmt::format("\"v{}\"", version.load());
    if (head.find("If-None-Match: " + etag) != std::string::npos) return HttpReply{304};
    return HttpReply{200, fmt::format("voice {}", version.load()), "ETag: " + etag + "\r\n"};
  });
  for (const int now : {1, 1, 2}) {
    version = now;
    open(*server);
    EXPECT_EQ(text_of(wait_for("turn.wav", "", AssetState::here).file), fmt::format("voice {}", now));
  }
  EXPECT_EQ(server->asked("/screw/turn.wav"), 3);
  // The copy is damaged: not modified does not help, the whole file comes.
  std::ofstream(cached(hash_of("voice 2"), ".wav")) << "noise";
  open(*server);
  EXPECT_EQ(text_of(wait_for("turn.wav", "", AssetState::here).file), "voice 2");
  // The server is gone: the copy will do.
  const std::string address = server->address("/screw");
  server.reset();
  open(address);
  EXPECT_EQ(text_of(wait_for("turn.wav", "", AssetState::here).file), "voice 2");
}

TEST_F(AssetStoreTest, what_was_not_used_for_the_longest_time_goes_first) {
  std::map<std::string, std::string> bodies;
  for (const char c : {'a', 'b', 'c', 'd'})
    bodies[fmt::format("/screw/{}.glb", c)] = std::string(1000, c);
  const SmallHttpServer server([&](const std::string& path, const std::string&) {
    return HttpReply{200, bodies[path]};
  });
  const auto fetch = [&](const char* name) {
    open(server);  // a store keeps what is its own
    wait_for(name, hash_of(bodies[std::string("/screw/") + name]), AssetState::here);
  };
  options_.cache_bytes = 3500;
  for (const char* name : {"a.glb", "b.glb", "c.glb", "a.glb", "d.glb"})
    fetch(name);
  const auto has = [&](char c) { return fs::exists(cached(hash_of(std::string(1000, c)))); };
  EXPECT_TRUE(has('a')) << "used again";
  EXPECT_FALSE(has('b'));
  EXPECT_TRUE(has('c'));
  EXPECT_TRUE(has('d'));
}

TEST_F(AssetStoreTest, a_cache_that_cannot_be_written_costs_the_cache_alone) {
  std::ofstream(top_ / "taken") << "a file stands where the folder should";
  options_.cache_folder = top_ / "taken";
  fs::path file;
  const SmallHttpServer server([&](const std::string&, const std::string&) { return HttpReply{200, body_}; });
  open(server);
  file = wait_for("a.glb", hash_, AssetState::here).file;
  EXPECT_EQ(text_of(file), body_);
  EXPECT_EQ(file.extension(), ".glb");
  EXPECT_TRUE(fs::is_regular_file(top_ / "taken"));
  store_.reset();
  EXPECT_FALSE(fs::exists(file)) << "what was put aside goes with the store";
}

TEST_F(AssetStoreTest, mesh_files_come_from_the_catalogue_or_the_server) {
  const SmallHttpServer server([&](const std::string&, const std::string&) { return HttpReply{200, body_}; });
  open(server);
  MeshFiles files(store_, nullptr);
  files.expect("a.glb", hash_);
  const auto first = files.find("a.glb");
  ASSERT_FALSE(first.has_value());
  EXPECT_THAT(first.error(), is_error(ErrorCode::busy, 0, {"a.glb"}));
  wait_for("a.glb", hash_, AssetState::here);
  const auto then = files.find("a.glb");
  ASSERT_TRUE(then.has_value());
  EXPECT_EQ(text_of(*then), body_);
}

}  // namespace
}  // namespace mechane::assets
