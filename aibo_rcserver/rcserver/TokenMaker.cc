#include "rcserver/TokenMaker.h"

#include <OPENR/OFbkImage.h>
#include <stdio.h>

#include "objects/HostSettings.h"

namespace {

// Every so many bytes one is used: not in all rows the same. These are 200 of an ERS-7's image, half of them of Y, Cr
// and Cb; two bits of noise in each make more than a token has.
const int PIXEL_STEP = 997;

// Spreads each bit over all others (the end of MurmurHash3, by Austin Appleby, public domain).
unsigned Spread(unsigned value) {
  value ^= value >> 16;
  value *= 0x85ebca6bU;
  value ^= value >> 13;
  value *= 0xc2b2ae35U;
  return value ^ (value >> 16);
}

}  // namespace

TokenMaker::TokenMaker() : one_(0x811c9dc5U), other_(0x9e3779b9U), has_image_(false) {
  Stir(hostSettings().random[0]);
  Stir(hostSettings().random[1]);
}

// Two different hashes: FNV-1a with whole words, and rotation with multiplication.
void TokenMaker::Stir(unsigned value) {
  one_ = (one_ ^ value) * 16777619U;
  other_ = (((other_ << 5) | (other_ >> 27)) ^ value) * 0x9e3779b1U;
}

void TokenMaker::Stir(OFbkImageVectorData* image) {
  OFbkImage y(image->GetInfo(ofbkimageLAYER_H), image->GetData(ofbkimageLAYER_H), ofbkimageBAND_Y);
  if (!y.IsValid()) {
    return;
  }
  has_image_ = true;
  const int size = y.Height() * (y.Width() + y.Skip());
  const byte* const pixels = y.Pointer();
  for (int i = 0; i < size; i += PIXEL_STEP) {
    Stir(pixels[i]);
  }
}

void TokenMaker::Make(char (&token)[protocol::version2::TOKEN_SIZE + 1]) {
  Stir(0x746f6b65U);
  sprintf(token, "%08x%08x", Spread(one_ ^ Spread(other_)), Spread(other_ + Spread(one_)));
}
