/// @file fbk_image_writer.h
/// Writes a picture in the layout of the ERS-7's camera: an OFbkImageVectorData followed by its pixels.
///
/// There are four layers: H, M with half its width and height, L with a quarter, and C, the colour detection, as large
/// as M with one byte per pixel. In H, M and L each row of Y is followed by the same row of Cr, of Cb and of the three
/// bands of fine detail (LH, HL, HH), so rows of one band are six widths apart. Y and the detail of a layer are one
/// step of a Haar wavelet transform: of the next larger layer's Y, and for H of the sensor with its 416x320 pixels. The
/// first 16 bytes of Y's last row, and of C's, are tag bytes: 0-3 the image number, little-endian; 4-7 how many pixels
/// the channels 4-7 of the colour detection have found, 8-11 the same of the channels 0-3, in sixteenths.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_FBK_IMAGE_WRITER_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_FBK_IMAGE_WRITER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/RCRegion.h>

#include "simulator/ers7/camera/color_detection.h"
#include "simulator/ers7/camera/ycrcb_image.h"

namespace simulated_ers7 {

/// Size in bytes of a region for one camera image in all layers.
std::size_t fbkImageSize();

/// Writes the constant part of an image: the vector's header, the infos, and an empty picture without fine detail.
/// @param region fbkImageSize() bytes
/// @param camera the camera's primitive, for the infos
void prepareFbkImage(RCRegion* region, OPrimitiveID camera);

/// Writes what can be known of an image before its picture is drawn. Its pixels are those of an earlier image or empty.
/// @param region prepared
/// @param frame OPEN-R frame of the capture
/// @param image_number the camera's own count, for the tag bytes
void announceFbkImage(RCRegion* region, longword frame, longword image_number);

/// Where the bands begin that come after Y, Cr and Cb of layer H: its detail, then the other layers.
/// @param region prepared
const void* otherBands(RCRegion* region);

/// Writes Y, Cr and Cb of layer H alone, which are most often all that is read. The tag says that no colours have been
/// detected, so this is for images without colour detection.
/// @param region announced
/// @param image_number as announced
void drawLargestColors(RCRegion* region, const YCrCbImage& picture, longword image_number);

/// Writes the whole picture into a region. The pixels of M and L are means of 2x2 and 4x4 pixels of H. C has the
/// colours detected in M.
/// @param region announced
/// @param image_number as announced
void drawFbkImage(RCRegion* region, const YCrCbImage& picture, const ColorDetection& colors, longword image_number);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_CAMERA_FBK_IMAGE_WRITER_H
