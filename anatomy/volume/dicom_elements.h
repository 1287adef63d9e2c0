#pragma once

#include <string_view>

namespace palpa::anatomy {

/// Whether GDCM may be given these bytes of a file. Debian's GDCM stops the program by an assertion
/// where an element is of no known kind or out of order, and takes as much memory as a length says
/// before it looks whether so much is there. The elements of a file (DICOM PS3.10) are walked as
/// far as they are plain (explicit VR, little endian): known kinds, rising tags, lengths that end
/// inside the file, a gray picture's figures within what they may be, pixels at the end. False for
/// what is no DICOM file. Nothing throws.
bool soundDicomElements(std::string_view bytes);

}  // namespace palpa::anatomy
