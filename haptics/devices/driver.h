#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "haptics/device.h"

/// What a driver of a haptic device is to the rest of the program, which knows no device by name.
namespace palpa::haptics {

/// Where a driver stands with its device.
enum class DriverState : std::uint8_t {
  closed,
  opening,    ///< not found yet, or not answering yet
  preparing,  ///< it is there and is made ready, which may take seconds
  homing,     ///< it answers, and a person has to show it where it is
  ready,      ///< positions are absolute, forces are rendered
  lost,       ///< it was there and is gone or silent; opened again as soon as it is back
};

struct DriverStatus {
  DriverState state = DriverState::closed;
  std::uint8_t problem = 0;     ///< the driver's own number of what is wrong; 0: nothing
  std::uint64_t exchanges = 0;  ///< answered
  std::uint64_t missed = 0;     ///< without an answer
  std::uint64_t opened = 0;
};

/// A real device as the haptic loop sees it. Three threads may hold it, which count the same time:
///   haptic   read() and command() exchange latest values; they never wait, allocate or throw
///   device   open(), then step() whenever it is due, then close(); these may wait
///   watcher  status(), one thread
/// A force is rendered only while the device's place is known, its last exchange was answered and
/// the command is younger than 10 ms; the last exchange before close() carries zero.
class Driver : public HapticDevice {
 public:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  virtual void open() noexcept = 0;
  /// One exchange, or whatever else is due; returns when the next is due (kNever: closed).
  virtual std::int64_t step(std::int64_t now_ns) noexcept = 0;
  virtual void close() noexcept = 0;
  virtual DriverStatus status() noexcept = 0;
  /// For whoever stands beside the device: what is wrong, where, what to do; empty: all is well.
  virtual std::string words(const DriverStatus& status) const = 0;
};

/// A field of its own that a driver reads in the section "device" of a station's file.
struct DriverField {
  enum class Kind : std::uint8_t { text, file, number, whole };
  std::string name;
  Kind kind = Kind::text;
  std::string title, about;    ///< for people
  double least = 0, most = 0;  ///< of a number
};

/// What a station's file says to its driver.
class DriverSettings {
 public:
  void set(const std::string& field, std::string text) { texts_[field] = std::move(text); }
  void set(const std::string& field, double number) { numbers_[field] = number; }
  /// Empty where it is not stated.
  std::string text(std::string_view field) const;
  std::filesystem::path file(std::string_view field) const { return text(field); }
  double number(std::string_view field, double otherwise) const;
  /// As words of a command, "field=value", and from them.
  std::vector<std::string> words() const;
  static DriverSettings ofWords(const std::vector<std::string>& words,
                                const std::vector<DriverField>& fields);

 private:
  std::map<std::string, std::string, std::less<>> texts_;
  std::map<std::string, double, std::less<>> numbers_;
};

/// What a driver found of something that its device needs: firmware, a library, a service.
struct DriverNeed {
  enum class State : std::uint8_t { well, absent, note, ill };  ///< absent: and not needed
  std::string subject;
  State state = State::well;
  std::string verdict;
  std::string fix = {};  ///< what to do; empty where nothing is to be done
};

struct UsbId {
  std::uint16_t vendor = 0, product = 0;
};

/// One driver: a folder beside this file whose `driver.cpp` defines
/// `const DriverDescription& description()` in a namespace with the folder's name.
struct DriverDescription {
  std::string name;   ///< in a station's file: device/driver
  std::string title;  ///< of the device: "Novint Falcon"
  std::vector<DriverField> fields;
  std::vector<UsbId> usb;  ///< by which the system knows it; empty: it is not on USB
  std::string udev_rule;   ///< file of assets/udev that lets a user open it; empty: none
  DeviceCapabilities (*capabilities)(const DriverSettings& settings) = nullptr;
  /// Throws Error for settings that cannot be used.
  std::unique_ptr<Driver> (*make)(const DriverSettings& settings) = nullptr;
  std::vector<DriverNeed> (*needs)(const DriverSettings& settings) = nullptr;  ///< or null
};

/// Of every folder with a `driver.cpp`, in the order of their names; the build makes the source.
std::vector<const DriverDescription*> listedDrivers();
const std::vector<const DriverDescription*>& drivers();
/// Null where there is none of this name.
const DriverDescription* driverNamed(std::string_view name);

}  // namespace palpa::haptics
