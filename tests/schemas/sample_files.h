#pragma once

#include <string>

/// Small sound files without a schema, written by the tests' own hand.
namespace palpa::schemas {

std::string openCvYaml();            ///< intrinsics of a camera
std::string openCvXml();             ///< the same
std::string dicomSlice(int number);  ///< of a series of 6 x 5 voxels
std::string patientGlb();
std::string sessionFile();  ///< a session's evidence: one trial

}  // namespace palpa::schemas
