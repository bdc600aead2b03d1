// Which requests to the studio may bring a file, and how long it may be.
#include <gtest/gtest.h>

#include "client-sdk/gateway/studio_api.hpp"
#include "client-sdk/studio/draft/archive.hpp"

namespace mechane::gateway {
namespace {

TEST(StudioUpload, FilesAndArchivesMayBeLonger) {
  const std::string draft = "/api/studio/drafts/crane/";
  EXPECT_EQ(longest_studio_upload(draft + "files/arm.glb"), studio::DraftFiles::kMostBytes);
  EXPECT_EQ(longest_studio_upload(draft + "import"), studio::kMostArchiveBytes);
  EXPECT_EQ(longest_studio_upload(draft + "picture"), studio::Shelf::kMostPictureBytes);
  for (const char* verb :
       {"", "import/more", "export", "files", "files/arm.glb/delete", "commands", "merge", "versions"})
    EXPECT_EQ(longest_studio_upload(draft + verb), 0U) << verb;
  EXPECT_EQ(longest_studio_upload("/api/studio/drafts/import"), 0U);
  EXPECT_EQ(longest_studio_upload("/api/files/arm.glb"), 0U);
}

}  // namespace
}  // namespace mechane::gateway
