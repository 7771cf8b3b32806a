#include "file_keeper/StickFiles.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <memory>

#include "motion_bytes.h"
#include "support/memory_stick.h"

namespace {

class FilesOnTheStick : public ::testing::Test {
 protected:
  FilesOnTheStick() {
    host_.memory_stick = stick_.path().c_str();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }

  // @return true if it was done
  bool carryOut(FileJob::Operation operation, const std::string& name = "", const std::string& content = "") {
    job_->operation = operation;
    job_->kind = MOTION_FILE;
    protocol::readMotionName(name.data(), name.size(), job_->name);
    job_->size = content.size();
    std::copy(content.begin(), content.end(), job_->content);
    return files_.CarryOut(*job_, result_.get()) == FileResult::DONE;
  }

  bool store(const std::string& name, const std::string& content) { return carryOut(FileJob::STORE, name, content); }

  std::vector<std::string> listed() {
    EXPECT_TRUE(carryOut(FileJob::LIST));
    return {result_->list.names, result_->list.names + result_->list.count};
  }

  test_support::MemoryStick stick_;
  std::filesystem::path folder_ = stick_.path(DATA_FOLDER);
  HostSettings host_;
  StickFiles files_{host_};
  const std::unique_ptr<FileJob> job_ = std::make_unique<FileJob>();
  const std::unique_ptr<FileResult> result_ = std::make_unique<FileResult>();
};

TEST_F(FilesOnTheStick, AnUploadFollowsNoLink) {
  stick_.write("elsewhere", "precious");
  for (const char* name : {"UPLOAD.TMP", "HOP.MTN"}) {
    std::filesystem::create_symlink(stick_.path("elsewhere"), folder_ / name);
  }
  EXPECT_TRUE(store("HOP.MTN", "new"));
  EXPECT_EQ(contentOf(stick_.path("elsewhere")), "precious");
  EXPECT_EQ(contentOf(folder_ / "HOP.MTN"), "new");
  EXPECT_FALSE(std::filesystem::is_symlink(folder_ / "HOP.MTN"));
}

TEST_F(FilesOnTheStick, WhatAResetHasLeftIsNoMotionAndDoesNotBlock) {
  for (const char* name : {"UPLOAD.TMP", "RESERVE.TMP"}) {
    stick_.write(std::string(DATA_FOLDER) + "/" + name, "half");
  }
  EXPECT_THAT(listed(), testing::IsEmpty());
  EXPECT_TRUE(store("HOP.MTN", "new"));
  EXPECT_EQ(contentOf(folder_ / "HOP.MTN"), "new");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "UPLOAD.TMP"));
}

TEST_F(FilesOnTheStick, AreListedUpTo256) {
  for (int i = 0; i < 300; ++i) {
    stick_.write(std::string(DATA_FOLDER) + "/M" + std::to_string(i) + ".MTN", "content");
  }
  EXPECT_THAT(listed(), testing::SizeIs(256));
}

TEST_F(FilesOnTheStick, FindsAFileInUpperOrLowerCase) {
  stick_.write(std::string(DATA_FOLDER) + "/Hop.mtn", "content");
  EXPECT_THAT(listed(), testing::ElementsAre("HOP.MTN"));
  EXPECT_TRUE(store("hop.MTN", "new"));
  EXPECT_THAT(namesIn(folder_), testing::ElementsAre("Hop.mtn"));
  EXPECT_TRUE(carryOut(FileJob::DELETE, "HOP.MTN"));
  EXPECT_THAT(namesIn(folder_), testing::IsEmpty());
}

TEST_F(FilesOnTheStick, AFullMemoryStickLeavesTheOldFileAndNothingElse) {
  EXPECT_TRUE(store("HOP.MTN", "old"));
  {
    const test_support::FullDisk full;
    EXPECT_FALSE(store("HOP.MTN", std::string(60000, 'x')));
  }
  EXPECT_THAT(namesIn(folder_), testing::ElementsAre("HOP.MTN"));
  EXPECT_EQ(contentOf(folder_ / "HOP.MTN"), "old");
}

}  // namespace
