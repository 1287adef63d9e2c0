#include "anatomy/volume/dicom_elements.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

namespace palpa::anatomy {
namespace {

/// What a gray picture says of its voxels: one sample, whole bytes, sign 0 or 1.
bool sensible(std::uint32_t tag, std::string_view value) {
  std::uint16_t number = 0;
  if (value.size() < 2) return false;
  std::memcpy(&number, value.data(), 2);
  switch (tag) {
    case 0x00280002:
      return number == 1;
    case 0x00280010:
    case 0x00280011:
      return number > 0 && number <= 4096;
    case 0x00280100:
      return number == 8 || number == 16 || number == 32;
    case 0x00280101:
      return number >= 1 && number <= 32;
    case 0x00280102:
      return number < 32;
    case 0x00280103:
      return number <= 1;
    default:
      return true;
  }
}

constexpr std::string_view kShortKinds = "AEASATCSDADSDTFLFDISLOLTPNSHSLSSSTTMUIULUS",
                           kLongKinds = "OBODOFOLOWSQUCUNURUT";
constexpr std::uint32_t kUndefined = 0xffffffff, kItem = 0xfffee000, kEndOfSequence = 0xfffee0dd,
                        kFirstData = 0x00080000;  // before it stand the elements about the file

bool among(std::string_view kinds, std::string_view kind) {
  for (std::size_t i = 0; i + 1 < kinds.size(); i += 2)
    if (kinds.substr(i, 2) == kind) return true;
  return false;
}

template <class Number>
Number numberAt(std::string_view bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, &bytes[at], sizeof number);
  return number;
}

std::uint32_t tagAt(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint32_t>(numberAt<std::uint16_t>(bytes, at)) << 16 |
         numberAt<std::uint16_t>(bytes, at + 2);
}

/// A length that a part of the file states, and where its content begins.
struct StatedLength {
  std::uint32_t length = 0;
  std::size_t content = 0;
};

/// None: the file ends, or the kind is not known (with kinds).
std::optional<StatedLength> lengthAt(std::string_view bytes, std::size_t at, bool with_kinds) {
  if (bytes.size() - at < 8) return std::nullopt;
  const bool mark = (tagAt(bytes, at) >> 16) == 0xfffe;  // of an item or an end: has no kind
  const std::string_view kind = bytes.substr(at + 4, 2);
  if (mark || !with_kinds) return StatedLength{numberAt<std::uint32_t>(bytes, at + 4), at + 8};
  if (among(kShortKinds, kind)) return StatedLength{numberAt<std::uint16_t>(bytes, at + 6), at + 8};
  if (!among(kLongKinds, kind) || bytes.size() - at < 12) return std::nullopt;
  return StatedLength{numberAt<std::uint32_t>(bytes, at + 8), at + 12};
}

/// Whether each part that is nested in others, or stands without its kind, ends inside the file.
/// GDCM takes as much memory as a length says before it looks whether so much is there. What cannot
/// be followed is left to GDCM.
bool lengthsFit(std::string_view bytes, std::size_t at, bool with_kinds) {
  bool pieces = false;  // of a compressed picture: what is in an item are no further parts
  int unknown = 0;      // sequences, one in another, of which the outermost has no kind inside
  while (at < bytes.size()) {
    const std::optional<StatedLength> stated = lengthAt(bytes, at, with_kinds && unknown == 0);
    if (!stated) return true;
    const std::uint32_t tag = tagAt(bytes, at);
    const std::string_view kind = with_kinds && unknown == 0 ? bytes.substr(at + 4, 2) : "";
    const bool open = stated->length == kUndefined, item = (tag >> 16) == 0xfffe;
    at = stated->content;
    if (!open && stated->length > bytes.size() - at) return false;
    if (tag == kEndOfSequence) {
      pieces = false;
      unknown = std::max(0, unknown - 1);
    }
    if (open && !item && (unknown > 0 || kind == "UN")) ++unknown;
    if (open && (kind == "OB" || kind == "OW")) pieces = true;
    const bool plain_sequence = !item && kind.empty() && bytes.size() - at >= 4 &&
                                stated->length >= 4 && tagAt(bytes, at) == kItem;
    const bool opens = open || (item && !pieces) || kind == "SQ" || plain_sequence;
    if (!opens) at += stated->length;
  }
  return true;
}

/// How a file says that its elements are written (PS3.5, annex A): GDCM reads them so, and takes a
/// length that stands in another way for gigabytes.
enum class Syntax { with_kinds, without_kinds, packed, large_byte_first };

Syntax syntaxNamed(std::string_view uid) {
  while (!uid.empty() && (uid.back() == ' ' || uid.back() == '\0')) uid.remove_suffix(1);
  if (uid == "1.2.840.10008.1.2.1.99") return Syntax::packed;
  if (uid == "1.2.840.10008.1.2.2") return Syntax::large_byte_first;
  for (const char* known : {"1.2.840.10008.1.2.1", "1.2.840.10008.1.2.4.", "1.2.840.10008.1.2.5"})
    if (uid.starts_with(known)) return Syntax::with_kinds;
  return Syntax::without_kinds;
}

}  // namespace

bool soundDicomElements(std::string_view bytes) {
  if (bytes.size() < 140 || bytes.compare(128, 4, "DICM") != 0) return false;
  std::uint32_t last = 0, meta = 0;
  Syntax syntax = Syntax::without_kinds;
  for (std::size_t at = 132; at < bytes.size();) {
    if (bytes.size() - at < 8) return false;
    const std::uint32_t tag = tagAt(bytes, at);
    const std::string_view kind = bytes.substr(at + 4, 2);
    if (tag >= kFirstData && last < kFirstData && at != 144 + static_cast<std::size_t>(meta))
      return false;
    if (tag < kFirstData && (tag >> 16 != 2 || !among("ULOBUISHAE", kind))) return false;
    if (tag <= last || (tag >> 16) == 0xfffe) return false;
    const std::optional<StatedLength> stated = lengthAt(bytes, at, true);
    if (!stated)
      return tag >= kFirstData && last < kFirstData &&  // elements without kinds begin here
             (syntax == Syntax::packed ||
              (syntax == Syntax::without_kinds && lengthsFit(bytes, at, false)));
    const std::uint32_t length = stated->length;
    if (length == kUndefined)
      return (kind == "SQ" || kind == "OB" || kind == "OW" || kind == "UN") &&
             lengthsFit(bytes, at, true);
    at = stated->content;
    if (length > bytes.size() - at) return false;
    if (tag >= kFirstData && syntax != Syntax::with_kinds) return false;
    if (tag == 0x00020000 && (length != 4 || kind != "UL")) return false;
    if (tag == 0x00020000) meta = numberAt<std::uint32_t>(bytes, at);
    if (kind == "US" && !sensible(tag, bytes.substr(at, length))) return false;
    if (tag == 0x00020010) syntax = syntaxNamed(bytes.substr(at, length));
    last = tag;
    at += length;
  }
  return last >= 0x7fe00010;
}

}  // namespace palpa::anatomy
