/// @file ODataFormats.h
/// Layouts of the data that goes to and from the system's own objects. All of them are vectors: a header, then one
/// info for each entry, then the data, which an info finds by its offset from the beginning of the header.
#ifndef OPENR_ODATAFORMATS_H
#define OPENR_ODATAFORMATS_H

#include <OPENR/OPENR.h>

const ODataType odataUNDEF = 0;
const ODataType odataNO_DIMENSION = 1;
const ODataType odataLENGTH = 2;          ///< in millionths of a metre
const ODataType odataFORCE = 8;           ///< in millionths of a newton
const ODataType odataACCELERATION = 9;    ///< in millionths of a metre per second squared
const ODataType odataTEMPERATURE = 11;    ///< in millionths of a degree Celsius
const ODataType odataPRESSURE = 12;       ///< in millionths of a pascal
const ODataType odataSWITCH = 14;         ///< oswitchON or oswitchOFF
const ODataType odataJOINT_VALUE = 18;    ///< what a joint reports, in millionths of a radian
const ODataType odataFBK_YCrCb = 19;      ///< a picture of the three bands Y, Cr, Cb
const ODataType odataFBK_CDT = 20;        ///< what the colour detection found
const ODataType odataFBK_YCrCb_HPF = 24;  ///< the three bands and three of fine detail in Y; ERS-7
const ODataType odataJOINT_COMMAND2 = 259;
const ODataType odataLED_COMMAND2 = 260;
const ODataType odataJOINT_COMMAND3 = 261;
const ODataType odataJOINT_COMMAND4 = 262;
const ODataType odataLED_COMMAND3 = 263;
const ODataType odataCOMMAND_VECTOR = 1024;
const ODataType odataSENSOR_FRAME_VECTOR = 1025;
const ODataType odataFBKIMAGE_VECTOR = 1027;

typedef longword OSwitchValue;
const OSwitchValue oswitchOFF = 0;
const OSwitchValue oswitchON = 1;

typedef longword OLEDValue;
const OLEDValue oledOFF = 0;
const OLEDValue oledON = 1;

/// Which of the two patterns of Sony's face LEDs is meant.
typedef word OLED3Mode;
const OLED3Mode oled3_MODE_A = 0;
const OLED3Mode oled3_MODE_B = 1;

/// The two states of an ear: let go, and drawn by its magnet.
typedef longword OJointValue4;
const OJointValue4 ojoint4_STATE0 = 0;
const OJointValue4 ojoint4_STATE1 = 1;

/// Begins every vector.
struct ODataVectorInfo {
  MemoryRegionID memRegionID;
  longword reserved1;
  longword offset;     ///< of this header in its memory region
  longword totalSize;  ///< bytes, from the first of this header to the last of the data
  ODataType type;
  longword infoOffset;  ///< of the first info from this header
  longword infoSize;    ///< bytes of one info
  longword maxNumData;  ///< entries there is room for
  longword numData;     ///< entries there are
  longword reserved2[7];
  byte optional[128];
};

// ---------------------------------------------------------------------------------------------------------- commands

const size_t ocommandMAX_FRAMES = 16;  ///< of 8 ms each

struct OCommandInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword numFrames;  ///< 1..ocommandMAX_FRAMES
  longword frameSize;  ///< bytes of one value, 8
  longword dataOffset;
  longword dataSize;
  longword padding;

  /// All but dataOffset, which belongs to the memory's maker.
  void Set(ODataType dataType, OPrimitiveID id, size_t frames) {
    type = dataType;
    primitiveID = id;
    frameNumber = 0;
    numFrames = static_cast<longword>(frames);
    frameSize = 8;
    dataSize = static_cast<longword>(8 * ocommandMAX_FRAMES);
  }
};

/// What one frame of a command is made of; one of the value types below is laid over it.
struct OCommandValue {
  longword words[2];
};

struct OJointCommandValue2 {
  slongword value;  ///< micro-radian
  longword padding;
};

struct OJointCommandValue4 {
  OJointValue4 value;
  word period;  ///< in frames of 8 ms
  word reserved;
};

struct OLEDCommandValue2 {
  OLEDValue led;
  word period;  ///< in frames of 8 ms
  word reserved;
};

struct OLEDCommandValue3 {
  sword intensity;  ///< 0..255
  OLED3Mode mode;
  word period;  ///< in frames of 8 ms
  word reserved;
};

struct OCommandData {
  OCommandValue value[ocommandMAX_FRAMES];
};

struct OCommandVectorData {
  ODataVectorInfo vectorInfo;
  OCommandInfo info[1];  ///< the first of vectorInfo.maxNumData

  void SetNumData(size_t count) { vectorInfo.numData = static_cast<longword>(count); }
  OCommandInfo* GetInfo(int index) { return &info[0] + index; }
  OCommandData* GetData(int index) {
    void* data = reinterpret_cast<byte*>(&vectorInfo) + GetInfo(index)->dataOffset;
    return static_cast<OCommandData*>(data);
  }
};

// ----------------------------------------------------------------------------------------------------------- sensors

const size_t osensorframeMAX_FRAMES = 16;  ///< room in an entry; one message carries 4 frames, 32 ms

struct OSensorFrameInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;  ///< of the first frame
  longword numFrames;
  longword frameSize;
  longword dataOffset;
  longword dataSize;
  longword padding;
};

struct OSensorValue {
  slongword value;  ///< in the unit of its info's type; a touch sensor's as it is, 0..80 on the ERS-7
  word signal;
  word padding[5];
};

/// What a joint reports, laid over an OSensorValue.
struct OJointValue {
  slongword value;  ///< micro-radian
  word signal;
  sword pwmDuty;
  slongword refValue;  ///< micro-radian
  word refSignal;
  word padding;
};

struct OSensorFrameData {
  OSensorValue frame[osensorframeMAX_FRAMES];
};

struct OSensorFrameVectorData {
  ODataVectorInfo vectorInfo;
  OSensorFrameInfo info[1];  ///< the first of vectorInfo.maxNumData

  OSensorFrameInfo* GetInfo(int index) { return &info[0] + index; }
  OSensorFrameData* GetData(int index) {
    void* data = reinterpret_cast<byte*>(&vectorInfo) + GetInfo(index)->dataOffset;
    return static_cast<OSensorFrameData*>(data);
  }
};

// ------------------------------------------------------------------------------------------------------------ camera

typedef longword OFbkImageLayer;
const OFbkImageLayer ofbkimageLAYER_H = 0;  ///< high resolution: 208x160 on the ERS-7
const OFbkImageLayer ofbkimageLAYER_M = 1;  ///< half of it each way
const OFbkImageLayer ofbkimageLAYER_L = 2;  ///< a quarter of it each way
const OFbkImageLayer ofbkimageLAYER_C = 3;  ///< colour detection
const size_t ofbkimageNUM_LAYER = 4;

typedef longword OFbkImageBand;
const OFbkImageBand ofbkimageBAND_Y = 0;
const OFbkImageBand ofbkimageBAND_Cr = 1;
const OFbkImageBand ofbkimageBAND_Cb = 2;
const OFbkImageBand ofbkimageBAND_CDT = 3;
const OFbkImageBand ofbkimageBAND_Y_LH = 4;
const OFbkImageBand ofbkimageBAND_Y_HL = 5;
const OFbkImageBand ofbkimageBAND_Y_HH = 6;

/// Of one layer.
struct OFbkImageInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword dataOffset;
  longword dataSize;
  longword width;   ///< pixels
  longword height;  ///< pixels
  longword padding;
};

/// One camera image in all layers. OFbkImage reads it.
struct OFbkImageVectorData {
  ODataVectorInfo vectorInfo;
  OFbkImageInfo info[ofbkimageNUM_LAYER];

  OFbkImageInfo* GetInfo(OFbkImageLayer layer) { return &info[layer]; }
  byte* GetData(OFbkImageLayer layer) { return reinterpret_cast<byte*>(&vectorInfo) + info[layer].dataOffset; }
};

#endif  // OPENR_ODATAFORMATS_H
