#pragma once

#include <mutex>
#include <stdexcept>

namespace amble::morphology {

/// What MuJoCo reports as a fatal error, after which its default handler ends the process.
class FatalComplaint : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Redirects MuJoCo's complaints while it lives: errors throw FatalComplaint, warnings (by default a log file
/// in the current folder) are dropped. The handlers belong to the whole process, so there is one at a time,
/// and a program that uses MuJoCo itself gets its own handlers back.
class ComplaintsCaught {
 public:
  ComplaintsCaught();
  ~ComplaintsCaught();
  ComplaintsCaught(const ComplaintsCaught&) = delete;
  ComplaintsCaught& operator=(const ComplaintsCaught&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
  void (*error_)(const char*);
  void (*warning_)(const char*);
};

}  // namespace amble::morphology
