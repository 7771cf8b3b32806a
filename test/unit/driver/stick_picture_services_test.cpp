#include <aibo_driver/DeletePicture.h>
#include <aibo_driver/FetchPicture.h>
#include <aibo_driver/ListPictures.h>
#include <aibo_driver/TakePictureOnRobot.h>
#include <gmock/gmock.h>

#include "node/services.h"
#include "support/fake_client.h"
#include "support/temporary_folder.h"
#include "support/test_pictures.h"
#include "unit/driver/call_service.h"

namespace aibo_driver::node {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class StickPictureServicesTest : public ::testing::Test {
 protected:
  StickPictureServicesTest() {
    aibo_client::Picture picture;
    picture.jpeg = test_pictures::makeNumbered(7);
    client_.picture = std::make_shared<aibo_client::Picture>(picture);
  }

  /// A memory stick is slow.
  template <typename Service>
  typename Service::Response call(const std::string& name, const typename Service::Request& request = {}) {
    client_.timeout = 15s;
    const auto response = test_support::callService<Service>(services_, name, request);
    EXPECT_EQ(client_.timeout, 15s) << name;
    return response;
  }

  TakePictureOnRobot::Response takePicture(std::uint8_t quality) {
    TakePictureOnRobot::Request request;
    request.quality = quality;
    return call<TakePictureOnRobot>("take_picture_on_robot", request);
  }

  FetchPicture::Response fetch(const std::string& name, const std::string& save_to = "") {
    FetchPicture::Request request;
    request.name = name;
    request.save_to = save_to;
    return call<FetchPicture>("fetch_picture", request);
  }

  DeletePicture::Response remove(const std::string& name) {
    DeletePicture::Request request;
    request.name = name;
    return call<DeletePicture>("delete_picture", request);
  }

  ListPictures::Response list() { return call<ListPictures>("list_pictures"); }

  DriverParameters parameters() const {
    DriverParameters parameters;
    parameters.picture_folder = folder_.path();
    parameters.frame_prefix = "left";
    return parameters;
  }

  test_support::TemporaryFolder folder_;
  test_support::FakeClient client_;
  Services services_ = stickPictureServices(parameters(), client_, [] { return 77; });
};

TEST_F(StickPictureServicesTest, TakeAPictureOfTheDriversQualityOrAnother) {
  const auto answer = takePicture(0);
  EXPECT_TRUE(answer.success);
  EXPECT_EQ(answer.name, "AIBO0001.JPG");
  EXPECT_THAT(answer.message, HasSubstr("AIBO0001.JPG is on the robot's memory stick."));
  takePicture(30);
  takePicture(255);
  EXPECT_THAT(client_.told, testing::ElementsAre("picture on robot 77", "picture on robot 30", "picture on robot 100"));
}

TEST_F(StickPictureServicesTest, ListAndDeletePictures) {
  const auto answer = list();
  EXPECT_TRUE(answer.success);
  EXPECT_THAT(answer.names, testing::ElementsAre("AIBO0001.JPG", "MINE.JPG"));
  EXPECT_EQ(answer.message, "Pictures on the robot: 2.");
  EXPECT_EQ(remove("mine").message, "MINE.JPG was deleted from the robot.");
  EXPECT_THAT(client_.told, testing::ElementsAre("list pictures", "delete MINE.JPG"));
}

TEST_F(StickPictureServicesTest, FetchAPictureByItsNameInAnyCase) {
  const auto answer = fetch("Mine.jpg");
  EXPECT_TRUE(answer.success);
  EXPECT_EQ(answer.image.data, client_.picture->jpeg);
  EXPECT_EQ(answer.image.format, "bgr8; jpeg compressed bgr8");
  EXPECT_EQ(answer.image.header.frame_id, "left/camera_optical_frame");
  EXPECT_TRUE(answer.image.header.stamp.isZero());
  EXPECT_THAT(client_.told, testing::ElementsAre("fetch MINE.JPG"));
}

TEST_F(StickPictureServicesTest, SaveAFetchedPicture) {
  EXPECT_TRUE(fetch("mine", "fetched.jpg").success);
  EXPECT_TRUE(std::filesystem::exists(folder_.path("fetched.jpg")));
  const auto unsaved = fetch("mine", "../fetched.jpg");
  EXPECT_FALSE(unsaved.success);
  EXPECT_THAT(unsaved.message, HasSubstr("It was not saved: "));
  EXPECT_EQ(unsaved.image.data, client_.picture->jpeg) << "the caller has it all the same";
}

TEST_F(StickPictureServicesTest, EachSaysWhyItFailed) {
  EXPECT_THAT(fetch("").message, HasSubstr("give the name of a picture. list_pictures lists them"));
  EXPECT_THAT(remove("").message, HasSubstr("Nothing was deleted: give the name of a picture"));
  EXPECT_THAT(client_.told, testing::IsEmpty());
  client_.problem = "there is no robot";
  EXPECT_EQ(takePicture(0).message, "There is no picture: there is no robot");
  EXPECT_EQ(list().message, "The pictures could not be listed: there is no robot");
  EXPECT_FALSE(fetch("mine").success || remove("mine").success);
}

}  // namespace
}  // namespace aibo_driver::node
