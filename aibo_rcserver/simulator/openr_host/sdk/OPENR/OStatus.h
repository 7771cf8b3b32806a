/// @file OStatus.h
#ifndef OPENR_OSTATUS_H
#define OPENR_OSTATUS_H

#include <Types.h>

typedef longword OStatus;

const OStatus oSUCCESS = 0;
const OStatus oUNDEF = 1;
const OStatus oFAIL = 2;
const OStatus oNOT_SUPPORTED = 3;
const OStatus oINVALID_ARG = 4;
const OStatus oNO_MEMORY = 5;
const OStatus oNOT_FOUND = 6;
const OStatus oALREADY_EXIST = 7;
const OStatus oOPEN_FAILURE = 8;
const OStatus oCLOSE_FAILURE = 9;
const OStatus oNOT_INITIALIZED = 18;
const OStatus oSIZE_TOO_LARGE = 20;
const OStatus oNOT_AVAILABLE = 21;
const OStatus oOUT_OF_RANGE = 24;
const OStatus oOVERFLOW = 25;
const OStatus oUNDERFLOW = 26;
const OStatus oBUSY = 33;

const OStatus oINVALID_PRIMITIVE_ID = 4096;
const OStatus oINVALID_DATA_TYPE = 4098;
const OStatus oNO_SYNC_KEY = 4106;
const OStatus oINVALID_SYNC_KEY = 4107;
const OStatus oGAIN_DISABLED = 4108;  ///< call EnableJointGain() first
const OStatus oDESIGNDATA_SIZE_ZERO = 4110;

const OStatus oALERT_JOINT_UNCONTROLLABLE = 8192;  ///< the joint cannot follow its commands

#endif  // OPENR_OSTATUS_H
