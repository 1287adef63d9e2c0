#pragma once

/// Calls that hang: while the file that PALPA_HANG names exists, calls of the kind that its first
/// word says wait, and FILE.reached is made by the first that does.
///
///   datagram   UDP sockets
///   stream     TCP sockets
///   local      Unix sockets with a name, but the emergency stop's ("NAME!")
///   evidence   writing session.palpa and what SQLite keeps beside it
///   film       reading a film (.mjpeg)
///   usb        transfers to a device
namespace palpa::test {

/// Waits as long as what this descriptor is of hangs; `errno` stays.
void waitWhileHung(int descriptor) noexcept;
/// As long as this kind does.
void waitWhileHung(const char* kind) noexcept;

}  // namespace palpa::test
