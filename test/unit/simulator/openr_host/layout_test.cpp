// The sizes, offsets and numbers in the OPEN-R SDK's documents and headers, checked at compile time. Structures with
// pointers are left out, because a pointer has 4 bytes on the robot.
#include <EndpointTypes.h>
#include <OPENR/OFbkImage.h>
#include <OPENR/OList.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OTime.h>
#include <OPENR/OUnits.h>
#include <OPENR/ObjcommMessages.h>
#include <TCPEndpointMsg.h>
#include <UDPEndpointMsg.h>

#include <cstddef>
#include <type_traits>
#include <utility>

template <typename Result, typename Type>
constexpr bool kIs = std::is_same<Result, Type>::value;

static_assert(sizeof(byte) == 1 && sizeof(sbyte) == 1 && sizeof(word) == 2 && sizeof(sword) == 2);
static_assert(sizeof(longword) == 4 && sizeof(slongword) == 4);
static_assert(std::is_unsigned<longword>::value && std::is_signed<slongword>::value);
static_assert(sizeof(OStatus) == 4 && sizeof(OPrimitiveID) == 4 && sizeof(ODataType) == 4 && sizeof(Selector) == 4);
static_assert(sizeof(MemoryRegionID) == 4 && sizeof(OVRSyncKey) == 4 && sizeof(ODesignDataID) == 4);

// ---------------------------------------------------------------------- Level2 Reference Guide, page 45: header
static_assert(sizeof(ODataVectorInfo) == 192);
static_assert(offsetof(ODataVectorInfo, memRegionID) == 0 && offsetof(ODataVectorInfo, physAddr) == 4);
static_assert(offsetof(ODataVectorInfo, offset) == 8 && offsetof(ODataVectorInfo, totalSize) == 12);
static_assert(offsetof(ODataVectorInfo, type) == 16 && offsetof(ODataVectorInfo, infoOffset) == 20);
static_assert(offsetof(ODataVectorInfo, infoSize) == 24 && offsetof(ODataVectorInfo, maxNumData) == 28);
static_assert(offsetof(ODataVectorInfo, numData) == 32 && offsetof(ODataVectorInfo, syncKey) == 36);
static_assert(offsetof(ODataVectorInfo, wait) == 40 && offsetof(ODataVectorInfo, optOffset) == 44);
static_assert(offsetof(ODataVectorInfo, optSize) == 48 && offsetof(ODataVectorInfo, padding) == 52);
static_assert(offsetof(ODataVectorInfo, optional) == 64);

// ------------------------------------------------------------------------------------------ pages 47 to 52: commands
static_assert(sizeof(OCommandVectorData) == 192 + 32 && offsetof(OCommandVectorData, info) == 192);
static_assert(sizeof(OCommandInfo) == 32);
static_assert(offsetof(OCommandInfo, type) == 0 && offsetof(OCommandInfo, primitiveID) == 4);
static_assert(offsetof(OCommandInfo, frameNumber) == 8 && offsetof(OCommandInfo, numFrames) == 12);
static_assert(offsetof(OCommandInfo, frameSize) == 16 && offsetof(OCommandInfo, dataOffset) == 20);
static_assert(offsetof(OCommandInfo, dataSize) == 24);
static_assert(ocommandMAX_FRAMES == 16 && sizeof(OCommandData) == 16 * 8 && sizeof(OCommandValue) == 8);
static_assert(sizeof(OJointCommandValue2) == 8 && sizeof(OJointCommandValue3) == 8 && sizeof(OJointCommandValue4) == 8);
static_assert(offsetof(OJointCommandValue3, reserved) == 4 && offsetof(OJointCommandValue4, period) == 4);
static_assert(sizeof(OLEDCommandValue2) == 8 && offsetof(OLEDCommandValue2, period) == 4);
static_assert(sizeof(OLEDCommandValue3) == 8 && offsetof(OLEDCommandValue3, mode) == 2);
static_assert(offsetof(OLEDCommandValue3, period) == 4 && offsetof(OLEDCommandValue3, reserved) == 6);
static_assert(oledOFF == 0 && oledON == 1);
static_assert(oled3_MODE_UNDEF == 0xffff && oled3_MODE_A == 0 && oled3_MODE_B == 1);
static_assert(ojoint3_STATE0 == 0 && ojoint3_STATE1 == 1 && ojoint4_STATE0 == 0 && ojoint4_STATE1 == 1);
static_assert(odataJOINT_COMMAND2 == 259 && odataLED_COMMAND2 == 260 && odataJOINT_COMMAND3 == 261);
static_assert(odataJOINT_COMMAND4 == 262 && odataLED_COMMAND3 == 263);
static_assert(odataCOMMAND_VECTOR == 1024 && odataSENSOR_FRAME_VECTOR == 1025 && odataSOUND_VECTOR == 1026);
static_assert(odataFBKIMAGE_VECTOR == 1027 && odataCDT_VECTOR == 1028);

// ------------------------------------------------------------------------------------------- pages 53 to 57: sensors
static_assert(sizeof(OSensorFrameVectorData) == 192 + 32 && sizeof(OSensorFrameInfo) == 32);
static_assert(offsetof(OSensorFrameInfo, numFrames) == 12 && offsetof(OSensorFrameInfo, dataOffset) == 20);
static_assert(osensorframeMAX_FRAMES == 16 && sizeof(OSensorFrameData) == 16 * 16);
static_assert(sizeof(OSensorValue) == 16 && offsetof(OSensorValue, signal) == 4);
static_assert(sizeof(OJointValue) == 16 && offsetof(OJointValue, signal) == 4 && offsetof(OJointValue, pwmDuty) == 6);
static_assert(offsetof(OJointValue, refValue) == 8 && offsetof(OJointValue, refSignal) == 12);
static_assert(sizeof(OSwitchStatus) == 16 && sizeof(OAcceleration) == 16 && sizeof(OLength) == 16);
static_assert(odataLENGTH == 2 && odataFORCE == 8 && odataACCELERATION == 9 && odataTEMPERATURE == 11);
static_assert(odataPRESSURE == 12 && odataSWITCH == 14 && odataJOINT_VALUE == 18);

// -------------------------------------------------------------------------------------------- pages 58 to 60: camera
static_assert(sizeof(OFbkImageVectorData) == 224 && offsetof(OFbkImageVectorData, info) == 192);
static_assert(sizeof(OFbkImageInfo) == 32 && offsetof(OFbkImageInfo, dataOffset) == 12);
static_assert(offsetof(OFbkImageInfo, width) == 20 && offsetof(OFbkImageInfo, height) == 24);
static_assert(odataFBK_YCrCb == 19 && odataFBK_CDT == 20 && odataFBK_YCrCb_HPF == 24);
static_assert(ofbkimageLAYER_H == 0 && ofbkimageLAYER_M == 1 && ofbkimageLAYER_L == 2 && ofbkimageLAYER_C == 3);
static_assert(ofbkimageBAND_Y == 0 && ofbkimageBAND_Cr == 1 && ofbkimageBAND_Cb == 2 && ofbkimageBAND_CDT == 3);
static_assert(kIs<byte, decltype(std::declval<OFbkImage>().ColorFrequency(ocdtCHANNEL0))>);
static_assert(sizeof(OPrimitiveControl_CameraParam) == 4 && oprmreqCAM_SET_WHITE_BALANCE == 384);

// ---------------------------------------------------------------------------------- pages 64 and 65: colour detection
static_assert(ocdtNUM_CHANNELS == 8 && sizeof(OCdtInfo) == 144 && sizeof(OCdtVectorData) == 192 + 8 * 144);
static_assert(offsetof(OCdtInfo, channel) == 8 && offsetof(OCdtInfo, table) == 12);
static_assert(ocdtCHANNEL0 == 0x01 && ocdtCHANNEL1 == 0x02 && ocdtCHANNEL2 == 0x04 && ocdtCHANNEL3 == 0x08);
static_assert(ocdtCHANNEL4 == 0x10 && ocdtCHANNEL5 == 0x20 && ocdtCHANNEL6 == 0x40 && ocdtCHANNEL7 == 0x80);
static_assert(ocdtINIT == 0x80808080 && ocdtMAX_Y_SEGMENT == 32);

// -------------------------------------------------------------------------------------------- pages 62 and 63: sound
static_assert(sizeof(OSoundVectorData) == 192 + 64 && sizeof(OSoundInfo) == 64);
static_assert(offsetof(OSoundInfo, dataOffset) == 16 && offsetof(OSoundInfo, dataSize) == 24);
static_assert(offsetof(OSoundInfo, format) == 28 && offsetof(OSoundInfo, samplingRate) == 32);
static_assert(offsetof(OSoundInfo, actualDataSize) == 36);

// ------------------------------------------------------------------------------------------------- pages 66 to 84: API
static_assert(orobotdesignNAME_MAX == 31 && ovrPATH_MAX == 127 && oserviceNAME_MAX == 127);
static_assert(oSUCCESS == 0 && oFAIL == 2 && oINVALID_ARG == 4 && oNO_MEMORY == 5 && oNOT_FOUND == 6);
static_assert(oINVALID_PRIMITIVE_ID == 4096 && oINVALID_DATA_TYPE == 4098 && oNO_SYNC_KEY == 4106);
static_assert(oGAIN_DISABLED == 4108 && oALERT_JOINT_UNCONTROLLABLE == 8192);
static_assert(oprimitiveID_UNDEF == 0xffffffff && ovrsynckeyUNDEF == 0xffffffff && odesigndataID_UNDEF == 0xffffffff);
static_assert(kIs<char*, decltype(std::declval<RCRegion>().Base())>);
static_assert(kIs<MemoryRegionID, decltype(std::declval<RCRegion>().MemID())>);
static_assert(MAX_MESSAGE_SIZE == 256 && MAX_NUM_DATA == 13);
static_assert(osyslogERROR == 1 && osyslogWARNING == 2 && osyslogINFO == 3 && osyslogMAX_SIZE == 243);
static_assert(oradiansPI == 3141592 && otimeTIME_DIF_UNDEF == 0x7f && otlSUCCESS == 0);

// -------------------------------------------------------------------------------------------- Internet Protocol
// Version4
static_assert(EndpointType_TCP == 1 && EndpointType_UDP == 2 && IP_PORT_ANY == 0);
static_assert(TCP_SUCCESS == 0 && TCP_CONNECTION_CLOSED == 2 && TCP_CONNECTION_RESET == 3);
static_assert(TCP_CONNECTION_TIMEOUT == 4 && TCP_CONNECTION_BUSY == 5 && TCP_ADDRESSINUSE == 6);
static_assert(TCP_PORT_UNREACHABLE == 8 && TCP_BUFFER_INVALID == 16 && TCP_OPERATION_INVALID == 17);
static_assert(UDP_SUCCESS == 0 && UDP_CONNECTION_CLOSED == 2 && UDP_CONNECTION_BUSY == 3 && UDP_ADDRESSINUSE == 4);
static_assert(UDP_MESSAGE_TOO_LONG == 10 && UDP_BUFFER_INVALID == 13 && UDP_OPERATION_INVALID == 14);

// Messages are copied byte by byte.
static_assert(std::is_trivially_destructible<TCPEndpointSendMsg>::value &&
              !std::is_polymorphic<TCPEndpointSendMsg>::value);
static_assert(std::is_trivially_destructible<UDPEndpointSendMsg>::value &&
              !std::is_polymorphic<UDPEndpointSendMsg>::value);
