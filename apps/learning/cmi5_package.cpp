#include "apps/learning/cmi5_package.h"

#include <zlib.h>

#include <cstdint>

#include "anatomy/base/uuid.h"
#include "apps/link/statement.h"

namespace palpa::learning {
namespace {

constexpr char kName[] = "cmi5.xml";

std::string inXml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string worded(const char* element, const std::string& words) {
  const std::string name = element;
  return "<" + name + "><langstring lang=\"en\">" + inXml(words) + "</langstring></" + name + ">";
}

std::string unitOf(const CourseTask& task, const std::string& root, const std::string& address) {
  return "    <au id=\"" + inXml(root + "/units/" + task.id) +
         "\" launchMethod=\"OwnWindow\" moveOn=\"CompletedAndPassed\" masteryScore=\"1.0\">\n     "
         " " +
         worded("title", task.title) + "\n      " + worded("description", task.about) +
         "\n      <url>" + inXml(address + "learning/cmi5/" + task.id) + "</url>\n    </au>\n";
}

/// Little-endian.
void put(std::string& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

/// What local head and directory say alike of one file that is stored as it is, from "version
/// needed" on (PKWARE APPNOTE 4.3.7, 4.3.12); dated 1980-01-01, so that the same course is the same
/// file.
std::string entryOf(const std::string& text) {
  constexpr std::uint32_t kVersion = 20, kDay = 0x21;
  const auto size = static_cast<std::uint32_t>(text.size());
  const auto* bytes = reinterpret_cast<const Bytef*>(text.data());
  std::string out;
  put(out, kVersion, 2);
  put(out, 0, 2);  // flags
  put(out, 0, 2);  // stored
  put(out, 0, 2);  // time
  put(out, kDay, 2);
  put(out, static_cast<std::uint32_t>(::crc32(0, bytes, size)), 4);
  put(out, size, 4);
  put(out, size, 4);
  put(out, sizeof kName - 1, 2);
  put(out, 0, 2);  // extra
  return out;
}

}  // namespace

std::string courseStructure(const std::vector<CourseTask>& tasks, const std::string& address) {
  // Another station's course is another one: its name follows from the address
  const std::string root = std::string(link::kNames) + "/courses/" +
                           uuidOfName("6ba7b811-9dad-11d1-80b4-00c04fd430c8", address);
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<courseStructure "
      "xmlns=\"https://w3id.org/xapi/profiles/cmi5/v1/CourseStructure.xsd\">\n  <course id=\"" +
      root + "\">\n    " + worded("title", "Palpa: palpation and needle procedures") + "\n    " +
      worded("description", "Practice and assessment at a Palpa station") +
      "\n  </course>\n  <block id=\"" + root + "/tasks\">\n    " +
      worded("title", "Tasks of this station") + "\n    " +
      worded("description", "Each is prepared at the station and begun there by hand") + "\n";
  for (const CourseTask& task : tasks) xml += unitOf(task, root, address);
  return xml + "  </block>\n</courseStructure>\n";
}

std::string coursePackage(const std::string& structure) {
  const std::string entry = entryOf(structure);
  std::string zip = "PK\x03\x04" + entry + kName + structure;
  const auto directory_at = static_cast<std::uint32_t>(zip.size());
  zip += "PK\x01\x02";
  put(zip, 20, 2);  // made by version 2.0
  zip += entry;
  put(zip, 0, 2);  // comment
  put(zip, 0, 2);  // disk
  put(zip, 0, 2);  // attributes
  put(zip, 0, 4);
  put(zip, 0, 4);  // the local head is at the beginning
  zip += kName;
  const auto directory_size = static_cast<std::uint32_t>(zip.size()) - directory_at;
  zip += "PK\x05\x06";
  put(zip, 0, 4);  // disks
  put(zip, 1, 2);
  put(zip, 1, 2);
  put(zip, directory_size, 4);
  put(zip, directory_at, 4);
  put(zip, 0, 2);
  return zip;
}

}  // namespace palpa::learning
