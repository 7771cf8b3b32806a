#include <aibo_driver/TakePicture.h>
#include <gmock/gmock.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "node/services.h"
#include "support/fake_client.h"
#include "support/temporary_folder.h"
#include "unit/driver/call_service.h"

namespace aibo_driver::node {
namespace {

using aibo_client::Picture;
using test_support::callService;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class StreamServicesTest : public ::testing::Test {
 protected:
  StreamServicesTest() {
    client_.present.state = aibo_client::ConnectionState::kConnected;
    Picture picture;
    picture.jpeg = {1, 2, 3};
    picture.width = 208;
    picture.height = 160;
    client_.picture = std::make_shared<Picture>(picture);
  }

  TakePicture::Response takePicture(std::uint8_t quality, const std::string& save_to = "",
                                    const std::string& resolution = "") {
    TakePicture::Request request;
    request.quality = quality;
    request.save_to = save_to;
    request.resolution = resolution;
    return callService<TakePicture>(pictureServices(), "take_picture", request);
  }

  Services pictureServices() {
    return takePictureServices(
        parameters_, client_, [] { return 77; },
        [](const Picture& picture) {
          sensor_msgs::CompressedImage message;
          message.data = picture.jpeg;
          return message;
        });
  }

  std_srvs::SetBool::Response setStreaming(bool on) {
    std_srvs::SetBool::Request request;
    request.data = static_cast<std::uint8_t>(on);
    return callService<std_srvs::SetBool>(stream_, "set_streaming", request);
  }

  test_support::FakeClient client_;
  bool has_subscriber_ = false;
  camera::StreamPolicy policy_{false, true, [this] { return has_subscriber_; },
                               [this](bool on) { client_.setStreaming(on); }};
  DriverParameters parameters_;
  Services stream_ = streamServices(parameters_, client_, policy_);
};

TEST_F(StreamServicesTest, APictureHasTheResolutionThatIsAskedFor) {
  takePicture(70);
  takePicture(70, "", "416x320");
  takePicture(70, "", "52x40");
  EXPECT_THAT(client_.told, ElementsAre("picture 70", "picture 70 of resolution 3", "picture 70 of resolution 2"));
  const auto answer = takePicture(70, "", "640x480");
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("'640x480' is not one of 52x40, 104x80, 208x160 or 416x320"));
  EXPECT_EQ(client_.told.size(), 3U);
}

TEST_F(StreamServicesTest, AnswerAPicture) {
  parameters_.take_picture_timeout = std::chrono::seconds(7);
  const auto answer = takePicture(0);
  EXPECT_EQ(client_.timeout, std::chrono::seconds(7)) << "no call waits longer";
  EXPECT_TRUE(answer.success);
  EXPECT_EQ(answer.message, "Took a picture of 208x160 pixels, 3 bytes, at quality 77.");
  EXPECT_THAT(answer.image.data, ElementsAre(1, 2, 3));
  takePicture(255);
  EXPECT_THAT(client_.told, ElementsAre("picture 77", "picture 100"));
}

TEST_F(StreamServicesTest, SayWhyAPictureHasAnotherQuality) {
  client_.stream_quality = 85;
  client_.present.protocol_version = 1;
  EXPECT_THAT(takePicture(85).message, HasSubstr("at quality 85."));
  EXPECT_THAT(takePicture(20).message, HasSubstr("at quality 85; it is a picture of the stream, and quality 20"));
  client_.present.protocol_version = 2;
  EXPECT_THAT(takePicture(95).message, HasSubstr("at quality 85; at quality 95 it would have been too large"));
}

TEST_F(StreamServicesTest, SaveAPictureOrSayWhyNot) {
  const test_support::TemporaryFolder folder;
  parameters_.picture_folder = folder.path().string();
  Picture picture = *client_.picture;
  picture.jpeg = {0xFF, 0xD8, 0xFF, 0xDA, 0, 2, 0xFF, 0xD9};  // the least that is a JPEG
  client_.picture = std::make_shared<Picture>(picture);
  const auto answer = takePicture(0, "picture.jpg");
  EXPECT_TRUE(answer.success);
  const std::filesystem::path file = std::filesystem::canonical(folder.path()) / "picture.jpg";
  EXPECT_THAT(answer.message, HasSubstr("Saved to '" + file.string() + "'"));
  EXPECT_EQ(std::filesystem::file_size(file), answer.image.data.size());
  const auto unsaved = takePicture(0, "/no/such/folder/picture.jpg");
  EXPECT_FALSE(unsaved.success);
  EXPECT_THAT(unsaved.message, HasSubstr("It was not saved: "));
  EXPECT_EQ(unsaved.image.data, picture.jpeg);
}

TEST_F(StreamServicesTest, SayWhyThereIsNoPicture) {
  client_.problem = "there is no robot";
  const auto answer = takePicture(0);
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(answer.message, "There is no picture: there is no robot");
}

TEST_F(StreamServicesTest, RefuseAPictureAtOnceWhileFourCallsWait) {
  Services services;
  std::vector<std::string> answers;
  const auto call = [&] { answers.push_back(callService<TakePicture>(services, "take_picture", {}).message); };
  services = takePictureServices(
      parameters_, client_, [] { return 77; },
      [&](const Picture&) {  // before a call is answered, the next one comes
        call();
        return sensor_msgs::CompressedImage();
      });
  call();
  EXPECT_THAT(answers, ElementsAre(HasSubstr("4 calls already wait for a picture"), HasSubstr("Took a picture"),
                                   HasSubstr("Took"), HasSubstr("Took"), HasSubstr("Took")));
}

TEST_F(StreamServicesTest, SwitchTheStreamAndSayWhatItWaitsFor) {
  EXPECT_THAT(setStreaming(true).message, HasSubstr("as soon as a camera topic has a subscriber"));
  has_subscriber_ = true;
  EXPECT_EQ(setStreaming(true).message, "The stream is on: the robot is asked for pictures.");
  const auto off = setStreaming(false);
  EXPECT_TRUE(off.success);
  EXPECT_EQ(off.message, "The stream is off: the robot is asked for no pictures.");
  EXPECT_EQ(client_.told.back(), "no stream");
}

TEST_F(StreamServicesTest, KeepTheWishForAStreamWhileTheRobotDoesNotAnswer) {
  client_.present.state = aibo_client::ConnectionState::kDisconnected;
  const auto answer = setStreaming(true);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, HasSubstr("the robot does not answer yet"));
  EXPECT_TRUE(policy_.wanted());
  EXPECT_TRUE(setStreaming(false).success) << "nothing is missing";
}

TEST_F(StreamServicesTest, ToggleTheStream) {
  callService<std_srvs::Trigger>(stream_, "toggle_streaming");
  EXPECT_TRUE(policy_.wanted());
  EXPECT_EQ(callService<std_srvs::Trigger>(stream_, "toggle_streaming").message,
            "The stream is off: the robot is asked for no pictures.");
  EXPECT_FALSE(policy_.wanted());
}

}  // namespace
}  // namespace aibo_driver::node
