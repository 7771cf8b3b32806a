#include "rcserver/camera/ImageObserver.h"

#include <gtest/gtest.h>

#include <ostream>

namespace {

struct Arrival {
  bool sent;
  int quality;
};

bool operator==(const Arrival& a, const Arrival& b) {
  return a.sent == b.sent && (!a.sent || a.quality == b.quality);
}

std::ostream& operator<<(std::ostream& out, const Arrival& arrival) {
  return arrival.sent ? out << "picture of quality " << arrival.quality : out << "nothing";
}

const Arrival kNothing{false, 0};

PictureOrder ofQuality(int quality) {
  return {static_cast<unsigned char>(quality), 0, 0, false, false};
}

Arrival picture(int quality) {
  return {true, quality};
}

class ImageObserverTest : public ::testing::Test {
 protected:
  Arrival imageArrives() {
    PictureOrder order = {};
    const bool sent = observer_.ImageArrived(++image_count_, &order);
    return {sent, order.quality};
  }

  void bringTo(ImageObserverState state) {
    if (state == IOS_PICTURE) {
      observer_.RequestPicture(ofQuality(70));
    }
    if (state == IOS_CONTINUOUS || state == IOS_STOPSEND) {
      observer_.ToggleStream(ofQuality(80));
    }
    if (state == IOS_STOPSEND) {
      observer_.ToggleStream(ofQuality(80));
    }
    ASSERT_EQ(observer_.State(), state);
  }

  ImageObserver observer_;
  unsigned image_count_ = 0xfffffffe;  // it overflows
};

// rcserver_test.cpp has the table of the four states and four events, with the whole server.

TEST_F(ImageObserverTest, PicturesOwedWhenTheStreamStopsAreSentAfterIt) {
  bringTo(IOS_CONTINUOUS);
  observer_.RequestPicture(ofQuality(20));
  observer_.RequestPicture(ofQuality(21));
  observer_.ToggleStream(ofQuality(80));
  EXPECT_EQ(imageArrives(), kNothing);
  EXPECT_EQ(observer_.State(), IOS_PICTURE);
  EXPECT_EQ(imageArrives(), picture(20));
  EXPECT_EQ(imageArrives(), picture(21));
  EXPECT_EQ(observer_.State(), IOS_IDLE);
}

TEST_F(ImageObserverTest, OwedPicturesKeepTheirOrderAndTheirQualities) {
  for (int round = 0; round < 5; ++round) {
    for (int quality = 0; quality <= 100; ++quality) {
      ASSERT_TRUE(observer_.RequestPicture(ofQuality(static_cast<unsigned char>(quality))));
    }
    for (int quality = 0; quality <= 100; ++quality) {
      ASSERT_EQ(imageArrives(), picture(quality));
    }
    ASSERT_EQ(imageArrives(), kNothing);
  }
}

TEST_F(ImageObserverTest, OwesNoMoreThanItsLimitAndForgetsNone) {
  for (size_t i = 0; i < ImageObserver::MAX_OWED; ++i) {
    ASSERT_TRUE(observer_.RequestPicture(ofQuality(static_cast<unsigned char>(i % 101))));
  }
  observer_.StartStream(ofQuality(60), 1);
  EXPECT_FALSE(observer_.RequestPicture(ofQuality(85)));
  EXPECT_EQ(imageArrives(), picture(0));
  EXPECT_TRUE(observer_.RequestPicture(ofQuality(85)));
  for (size_t i = 1; i < ImageObserver::MAX_OWED; ++i) {
    ASSERT_EQ(imageArrives(), picture(static_cast<int>(i % 101)));
  }
  EXPECT_EQ(imageArrives(), picture(85));
  EXPECT_EQ(imageArrives(), picture(60)) << "the stream goes on";
}

// Additions of version 2.

TEST_F(ImageObserverTest, StreamOfEveryThirdImageLeavesOutTheOthers) {
  observer_.StartStream(ofQuality(60), 3);
  for (int round = 0; round < 5; ++round) {
    EXPECT_EQ(imageArrives(), picture(60));
    EXPECT_EQ(imageArrives(), kNothing);
    EXPECT_EQ(imageArrives(), kNothing);
  }
  EXPECT_EQ(imageArrives(), picture(60));
  observer_.StartStream(ofQuality(61), 3);
  EXPECT_EQ(imageArrives(), picture(61)) << "a new stream begins at once";
}

TEST_F(ImageObserverTest, StreamOfEveryImageGoesOnThoughTheCameraDoesNotCount) {
  observer_.StartStream(ofQuality(60), 1);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(imageArrives(), picture(60));
    --image_count_;
  }
}

TEST_F(ImageObserverTest, ImageThatWasTooEarlyToBeSentCountsForEveryNth) {
  observer_.StartStream(ofQuality(60), 3);
  EXPECT_EQ(imageArrives(), picture(60));
  image_count_ += 10;
  EXPECT_EQ(imageArrives(), picture(60));
  EXPECT_EQ(imageArrives(), kNothing);
}

TEST_F(ImageObserverTest, StreamContinuesWithNewSettings) {
  observer_.StartStream(ofQuality(60), 3);
  EXPECT_EQ(imageArrives(), picture(60));
  observer_.StartStream(ofQuality(61), 1);
  EXPECT_EQ(imageArrives(), picture(61));
  EXPECT_EQ(imageArrives(), picture(61));
}

TEST_F(ImageObserverTest, StoppingWithoutAStreamChangesNothing) {
  observer_.StopStream();
  EXPECT_EQ(observer_.State(), IOS_IDLE);
  bringTo(IOS_PICTURE);
  observer_.StopStream();
  EXPECT_EQ(observer_.State(), IOS_PICTURE);
}

TEST_F(ImageObserverTest, NothingIsOwedToTheNextClient) {
  bringTo(IOS_CONTINUOUS);
  observer_.RequestPicture(ofQuality(20));
  observer_.ClientGone();
  EXPECT_EQ(imageArrives(), kNothing);
  observer_.RequestPicture(ofQuality(21));
  EXPECT_EQ(imageArrives(), picture(21));
  EXPECT_EQ(imageArrives(), kNothing);
}

TEST_F(ImageObserverTest, PictureHasTheLayerAndTheNumberOfItsRequest) {
  observer_.RequestPicture({60, 2, 4711, false, false});
  PictureOrder order = {};
  ASSERT_TRUE(observer_.ImageArrived(1, &order));
  EXPECT_EQ(order.layer, 2);
  EXPECT_EQ(order.request_number, 4711);
}

}  // namespace
