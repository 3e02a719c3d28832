#pragma once

#include <stdexcept>
#include <string>

/// The few exception types of tetraglass. Each carries one line for the user: which file (if any),
/// what is wrong and where, and what to do about it. `apps` prints it after "tetraglass: error: ".
namespace tetraglass::base {

/// What could not be done. The program ends with status 1.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be read, or whose content is wrong: "FILE: what".
class ReadError : public Error {
 public:
  ReadError(const std::string& file, const std::string& what) : Error(file + ": " + what) {}
};

/// A file that cannot be written: "FILE: what".
class WriteError : public Error {
 public:
  WriteError(const std::string& file, const std::string& what) : Error(file + ": " + what) {}
};

/// Data that is well formed but cannot be used as asked (no such field, an open surface, no cells).
class InputError : public Error {
 public:
  using Error::Error;
};

/// Something this machine or this build lacks (no OpenGL context, a library switched off).
class UnavailableError : public Error {
 public:
  using Error::Error;
};

/// A request that contradicts itself or the contract. The program ends with status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tetraglass::base
