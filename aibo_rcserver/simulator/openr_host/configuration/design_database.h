/// @file design_database.h
/// DESIGNDB.CFG: files that objects find by a keyword (OPEN-R SDK Programmer's Guide, 4.2.3).
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_DESIGN_DATABASE_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_DESIGN_DATABASE_H

#include <istream>
#include <map>
#include <string>

namespace openr_host {

/// Reads the text of a DESIGNDB.CFG: a keyword, white space and a file's path a line, with comments and models as in
/// OBJECT.CFG.
/// @param file its name, for errors
/// @param design the robot's model
/// @return the path on the stick, "OPEN-R/MW/DATA/P/SOUND.WAV", of each keyword
/// @throw ConfigurationError if a line is something else, or has a keyword a second time
std::map<std::string, std::string> readDesignDatabase(std::istream& text, const std::string& file,
                                                      const std::string& design);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_DESIGN_DATABASE_H
