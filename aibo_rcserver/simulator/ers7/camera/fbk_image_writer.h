/// @file fbk_image_writer.h
/// Writes a picture in the layout of the ERS-7's camera: an OFbkImageVectorData, then the pixels.
///
/// M has half the width and height of H, and L a quarter. C is the colour detection, as large as M, with one byte per
/// pixel. In H, M and L each row of Y is followed by the same row of Cr, of Cb and of the three bands of fine detail
/// (LH, HL, HH), so rows of a band are six widths apart. Y and the detail of a layer are one step of a Haar wavelet
/// transform of the next larger layer's Y; for H, of the sensor's 416x320 pixels. The last rows of Y and C begin with
/// 16 tag bytes. Bytes 0-3 are the image number, little-endian. Bytes 4-7 are how many pixels colour channels 4-7
/// found, and bytes 8-11 the same for channels 0-3, in sixteenths.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_FBK_IMAGE_WRITER_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_FBK_IMAGE_WRITER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/RCRegion.h>

#include "simulator/ers7/camera/color_detection.h"
#include "simulator/ers7/camera/ycrcb_image.h"

namespace simulated_ers7 {

/// The size of an image in all layers, in bytes.
std::size_t fbkImageSize();

/// Writes the constant part: the vector's header, the infos, and an empty picture.
/// @param region a region of fbkImageSize() bytes
/// @param camera the camera's primitive
void prepareFbkImage(RCRegion* region, OPrimitiveID camera);

/// Writes everything that is known before the picture is drawn. The pixels stay those of an earlier image, or empty.
/// @param region a prepared region
/// @param frame the OPEN-R frame of the capture
/// @param image_number the camera's own counter, for the tag
void announceFbkImage(RCRegion* region, longword frame, longword image_number);

/// Writes the whole picture. Pixels of M and L are means of 2x2 and 4x4 pixels of H. C has the colours detected in M.
/// @param region an announced region
/// @param image_number the number that was announced
void drawFbkImage(RCRegion* region, const YCrCbImage& picture, const ColorDetection& colors, longword image_number);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_FBK_IMAGE_WRITER_H
