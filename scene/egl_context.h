#pragma once

#include <string>

#include "scene/gl_context.h"

namespace palpa::scene {

/// A desktop OpenGL (core, 3.2 or later) context without any surface or window system. Looks in
/// this order: EGL devices with hardware behind them, Mesa's surfaceless platform, Mesa's software
/// device. Throws Error when none gives a context.
class EglContext {
 public:
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void makeCurrent() const;  ///< in the calling thread; throws Error
  bool isCurrent() const;
  NativeContext native() const;
  const std::string& name() const { return name_; }  ///< "surfaceless EGL" or "EGL device"

 private:
  bool open(void* display, const char* name);

  void* display_ = nullptr;  // EGLDisplay; stays initialised: others in the process may share it
  void *config_ = nullptr, *context_ = nullptr;  // EGLConfig, EGLContext
  std::string name_;
};

}  // namespace palpa::scene
