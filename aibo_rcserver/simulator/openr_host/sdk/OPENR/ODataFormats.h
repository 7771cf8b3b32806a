/// @file ODataFormats.h
/// Layouts of the data to and from system objects. All are vectors: a header, then an info for each entry, then the
/// data. An info has its data's offset from the beginning of the header.
#ifndef OPENR_ODATAFORMATS_H
#define OPENR_ODATAFORMATS_H

#include <OPENR/OPENR.h>
#include <OPENR/OUnits.h>

typedef longword ODataType;

const ODataType odataUNDEF = 0;
const ODataType odataNO_DIMENSION = 1;
const ODataType odataLENGTH = 2;             ///< in millionths of a metre
const ODataType odataMASS = 3;               ///< in millionths of a kilogram
const ODataType odataTIME = 4;               ///< in millionths of a second
const ODataType odataDATE = 5;               ///< time_t
const ODataType odataANGULAR = 6;            ///< in millionths of a radian
const ODataType odataVELOCITY = 7;           ///< in millionths of a metre per second
const ODataType odataFORCE = 8;              ///< in millionths of a newton
const ODataType odataACCELERATION = 9;       ///< in millionths of a metre per second squared
const ODataType odataANGULAR_VELOCITY = 10;  ///< in millionths of a radian per second
const ODataType odataTEMPERATURE = 11;       ///< in millionths of a degree Celsius
const ODataType odataPRESSURE = 12;          ///< in millionths of a pascal
const ODataType odataPERCENTAGE = 13;        ///< in millionths of a per cent
const ODataType odataSWITCH = 14;            ///< oswitchON or oswitchOFF
const ODataType odataLED = 15;               ///< oledON or oledOFF
const ODataType odataSOUND = 16;
const ODataType odataIMAGE = 17;
const ODataType odataJOINT_VALUE = 18;    ///< a joint's reading, in microradians
const ODataType odataFBK_YCrCb = 19;      ///< bands Y, Cr and Cb
const ODataType odataFBK_CDT = 20;        ///< the result of the colour detection
const ODataType odataCDT = 21;            ///< a table for the colour detection
const ODataType odataFBK_YCrCb_HPF = 24;  ///< Y, Cr, Cb and three bands of fine detail; ERS-7
const ODataType odataJOINT_COMMAND = 256;
const ODataType odataLED_COMMAND = 258;
const ODataType odataJOINT_COMMAND2 = 259;
const ODataType odataLED_COMMAND2 = 260;
const ODataType odataJOINT_COMMAND3 = 261;
const ODataType odataJOINT_COMMAND4 = 262;
const ODataType odataLED_COMMAND3 = 263;
const ODataType odataCOMMAND_VECTOR = 1024;
const ODataType odataSENSOR_FRAME_VECTOR = 1025;
const ODataType odataSOUND_VECTOR = 1026;
const ODataType odataFBKIMAGE_VECTOR = 1027;
const ODataType odataCDT_VECTOR = 1028;

typedef longword OSwitchValue;
const OSwitchValue oswitchOFF = 0;
const OSwitchValue oswitchON = 1;

typedef longword OLEDValue;
const OLEDValue oledOFF = 0;
const OLEDValue oledON = 1;

/// One of the two patterns of Sony's face LEDs.
typedef word OLED3Mode;
const OLED3Mode oled3_MODE_UNDEF = 0xffff;
const OLED3Mode oled3_MODE_A = 0;
const OLED3Mode oled3_MODE_B = 1;

/// An ERS-210's ear: let go, or drawn by its magnet.
typedef longword OJointValue3;
const OJointValue3 ojoint3_STATE_UNDEF = 0xffffffffU;
const OJointValue3 ojoint3_STATE0 = 0;
const OJointValue3 ojoint3_STATE1 = 1;

/// An ERS-7's ear.
typedef longword OJointValue4;
const OJointValue4 ojoint4_STATE_UNDEF = 0xffffffffU;
const OJointValue4 ojoint4_STATE0 = 0;
const OJointValue4 ojoint4_STATE1 = 1;

const size_t odataOPTIONAL_MAX = 128;

/// The header of every vector (OPEN-R SDK Level2 Reference Guide, page 45). Sizes and offsets are the robot's size_t,
/// of 32 bits.
struct ODataVectorInfo {
  MemoryRegionID memRegionID;
  longword physAddr;   ///< address for the robot's devices; 0 on Linux
  longword offset;     ///< this header's offset in its memory region
  longword totalSize;  ///< bytes, from this header to the end of the data
  ODataType type;
  longword infoOffset;  ///< the first info's offset from this header
  longword infoSize;    ///< bytes of one info
  longword maxNumData;  ///< capacity in entries
  longword numData;     ///< number of entries
  OVRSyncKey syncKey;   ///< command vectors with the same key start together
  longword wait;        ///< delay of a command or sound vector in frames of 8 ms
  longword optOffset;   ///< where the part of `optional` begins that is passed on
  longword optSize;     ///< bytes of that part
  longword padding[3];
  byte optional[odataOPTIONAL_MAX];  ///< copied into the sensor vectors
};

// ---------------------------------------------------------------------------------------------------------- commands

const size_t ocommandMAX_FRAMES = 16;  ///< frames of 8 ms

struct OCommandInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword numFrames;  ///< 1..ocommandMAX_FRAMES
  longword frameSize;  ///< 8, in bytes; NewCommandVectorData() sets this and the next two members
  longword dataOffset;
  longword dataSize;  ///< 128
  longword padding[1];

  /// Sets what objects choose. NewCommandVectorData() sets the rest.
  void Set(ODataType dataType, OPrimitiveID id, size_t frames) {
    type = dataType;
    primitiveID = id;
    numFrames = static_cast<longword>(frames);
  }
};

/// One frame of a command: one of the value types below.
struct OCommandValue {
  slongword value[2];
};

struct OJointCommandValue2 {
  slongword value;  ///< microradians
  longword padding;
};

struct OJointCommandValue3 {
  OJointValue3 value;
  word reserved;
  word padding;
};

struct OJointCommandValue4 {
  OJointValue4 value;
  word period;  ///< frames of 8 ms
  word reserved;
};

struct OLEDCommandValue2 {
  OLEDValue led;
  word period;  ///< frames of 8 ms
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

const word osensorframeINVALID_SIGNAL = 0xffff;
const slongword opsdINVALID_VALUE = 0;  ///< a range finder that sees nothing reports this

const size_t osensorframeMAX_FRAMES = 16;  ///< capacity of an entry; a message carries 4 frames, 32 ms

struct OSensorFrameInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;  ///< the first frame's
  longword numFrames;
  longword frameSize;
  longword dataOffset;
  longword dataSize;
  longword padding[1];

  void Set(ODataType dataType, OPrimitiveID id, size_t frames) {
    type = dataType;
    primitiveID = id;
    numFrames = static_cast<longword>(frames);
  }
};

struct OSensorValue {
  slongword value;  ///< in the unit of its info's type; a touch sensor's is 0..80 on the ERS-7
  word signal;
  word padding[5];
};

/// Views of an OSensorValue.
typedef OSensorValue OAcceleration;
typedef OSensorValue OAngularVelocity;
typedef OSensorValue OTemperature;
typedef OSensorValue OForce;
typedef OSensorValue OPressure;
typedef OSensorValue OLength;

/// Has the layout of an OSensorValue.
struct OSwitchStatus {
  OSwitchValue value;
  word signal;
  word padding[5];
};

/// Has the layout of an OSensorValue.
struct OJointValue {
  slongword value;  ///< microradians
  word signal;
  sword pwmDuty;
  slongword refValue;  ///< microradians
  word refSignal;
  word padding[1];
};

struct OSensorFrameData {
  OSensorValue frame[osensorframeMAX_FRAMES];
};

struct OSensorFrameVectorData {
  ODataVectorInfo vectorInfo;
  OSensorFrameInfo info[1];  ///< the first of vectorInfo.maxNumData

  void SetNumData(size_t count) { vectorInfo.numData = static_cast<longword>(count); }
  OSensorFrameInfo* GetInfo(int index) { return &info[0] + index; }
  OSensorFrameData* GetData(int index) {
    void* data = reinterpret_cast<byte*>(&vectorInfo) + GetInfo(index)->dataOffset;
    return static_cast<OSensorFrameData*>(data);
  }
};

// ------------------------------------------------------------------------------------------------------------ camera

typedef int OFbkImageLayer;
const OFbkImageLayer ofbkimageLAYER_H = 0;  ///< high resolution: 208x160 on the ERS-7
const OFbkImageLayer ofbkimageLAYER_M = 1;  ///< half of this width and height
const OFbkImageLayer ofbkimageLAYER_L = 2;  ///< a quarter of it
const OFbkImageLayer ofbkimageLAYER_C = 3;  ///< colour detection

struct OFbkImageInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword dataOffset;
  longword dataSize;
  longword width;
  longword height;  ///< pixels
  longword padding[1];
};

/// One camera image in all layers, for OFbkImage.
struct OFbkImageVectorData {
  ODataVectorInfo vectorInfo;
  OFbkImageInfo info[1];  ///< the first of vectorInfo.maxNumData, one for each layer

  void SetPrimitiveID(OPrimitiveID id) {
    for (longword i = 0; i < vectorInfo.numData; ++i) {
      GetInfo(static_cast<int>(i))->primitiveID = id;
    }
  }
  OFbkImageInfo* GetInfo(int layer) { return &info[0] + layer; }
  byte* GetData(int layer) { return reinterpret_cast<byte*>(&vectorInfo) + GetInfo(layer)->dataOffset; }
};

// --------------------------------------------------------------------------------------------------- colour detection

const int ocdtNUM_CHANNELS = 8;

typedef longword OCdtChannel;  ///< one bit for each channel
const OCdtChannel ocdtCHANNEL_UNDEF = 0x00;
const OCdtChannel ocdtCHANNEL0 = 0x01;
const OCdtChannel ocdtCHANNEL1 = 0x02;
const OCdtChannel ocdtCHANNEL2 = 0x04;
const OCdtChannel ocdtCHANNEL3 = 0x08;
const OCdtChannel ocdtCHANNEL4 = 0x10;
const OCdtChannel ocdtCHANNEL5 = 0x20;
const OCdtChannel ocdtCHANNEL6 = 0x40;
const OCdtChannel ocdtCHANNEL7 = 0x80;

const int ocdtMAX_Y_SEGMENT = 32;
const longword ocdtINIT = 0x80808080U;  ///< a segment that contains no colour
const longword ocdtCr_MAX_MASK = 0x0000ff00U;
const longword ocdtCr_MIN_MASK = 0x000000ffU;
const longword ocdtCb_MAX_MASK = 0xff000000U;
const longword ocdtCb_MIN_MASK = 0x00ff0000U;

/// The colours of one channel: a rectangle of Cr and Cb for each of 32 steps of brightness.
struct OCdtInfo {
  ODataType type;
  OPrimitiveID primitiveID;  ///< the camera
  OCdtChannel channel;
  longword table[ocdtMAX_Y_SEGMENT];
  longword padding;

  /// An empty table detects no colour.
  void Init(OPrimitiveID id, OCdtChannel cdt_channel) {
    type = odataCDT;
    primitiveID = id;
    channel = cdt_channel;
    for (int i = 0; i < ocdtMAX_Y_SEGMENT; ++i) {
      table[i] = ocdtINIT;
    }
  }

  /// @param y_segment 0..ocdtMAX_Y_SEGMENT-1, from dark to bright
  /// @param cr_max, cr_min, cb_max, cb_min 0..255
  void Set(int y_segment, byte cr_max, byte cr_min, byte cb_max, byte cb_min) {
    table[y_segment] = static_cast<longword>(cb_max) << 24 | static_cast<longword>(cb_min) << 16 |
                       static_cast<longword>(cr_max) << 8 | static_cast<longword>(cr_min);
  }
};

struct OCdtVectorData {
  ODataVectorInfo vectorInfo;
  OCdtInfo info[ocdtNUM_CHANNELS];

  void SetNumData(size_t count) { vectorInfo.numData = static_cast<longword>(count); }
  OCdtInfo* GetInfo(int index) { return &info[index]; }
};

// ------------------------------------------------------------------------------------------------------------- sound

typedef word OSoundFormat;
const OSoundFormat osoundformatUNDEF = 0;
const OSoundFormat osoundformatPCM = 1;

typedef word OSoundChannel;
const OSoundChannel osoundchannelUNDEF = 0;
const OSoundChannel osoundchannelMONO = 1;
const OSoundChannel osoundchannelSTEREO = 2;

struct OSoundInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword frameSize;
  longword dataOffset;
  longword maxDataSize;
  longword dataSize;  ///< bytes
  OSoundFormat format;
  OSoundChannel channel;
  word samplingRate;  ///< Hz
  word bitsPerSample;
  longword actualDataSize;
  longword padding[6];

  void Set(ODataType dataType, OPrimitiveID id, size_t bytes) {
    type = dataType;
    primitiveID = id;
    dataSize = static_cast<longword>(bytes);
  }
};

struct OSoundSampleStereo16 {
  sword L;
  sword R;
};

struct OSoundVectorData {
  ODataVectorInfo vectorInfo;
  OSoundInfo info[1];  ///< the first of vectorInfo.maxNumData

  void SetNumData(size_t count) { vectorInfo.numData = static_cast<longword>(count); }
  OSoundInfo* GetInfo(int index) { return &info[0] + index; }
  byte* GetData(int index) { return reinterpret_cast<byte*>(&vectorInfo) + GetInfo(index)->dataOffset; }
};

#endif  // OPENR_ODATAFORMATS_H
