#include "client-sdk/gateway/drafts/studio_desk.hpp"

#include <utility>

#include "client-sdk/studio/shelf/shelf.hpp"

namespace mechane::gateway {
namespace {

constexpr std::size_t kMostStudioJobs = 32;

}  // namespace

StudioDesk::StudioDesk(const std::filesystem::path& scenarios, const std::filesystem::path& state, Post post)
    : shelf_(scenarios.empty() ? nullptr : std::make_unique<studio::Shelf>(scenarios, state / "studio")),
      post_(std::move(post)) {}

StudioDesk::~StudioDesk() = default;

void StudioDesk::give(Work work, Site::Done done) {
  if (!shelf_)
    return done(refusal(404, "this gateway was started without exhibits", "start it with --scenarios FOLDER"));
  if (waiting_ >= kMostStudioJobs)
    return done(refusal(503, "the gateway is busy with other drafts", "try again in a moment"));
  ++waiting_;
  thread_.give([this, work = std::move(work), done = std::move(done)] {
    post_([this, done, answer = work(*shelf_)] {
      --waiting_;
      done(answer);
    });
  });
}

}  // namespace mechane::gateway
