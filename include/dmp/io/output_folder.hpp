#pragma once
#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <dmp/core/require.hpp>
#include <dmp/io/detail/file.hpp>
#include <unistd.h>

namespace dmp::io {

/// The folder of a run's output: created with its parents, and found writable, before anything is computed.
///   const OutputFolder results("results/dam_break");   results / "front.csv"   // the path of a file in it
class OutputFolder {
 public:
  explicit OutputFolder(std::filesystem::path path) : path_(std::move(path)) {
    if (path_.empty()) throw ParameterError("io::OutputFolder: the path must not be empty");
    std::error_code error;
    std::filesystem::create_directories(path_, error);
    if (error) reject("cannot create", error.message());
    if (!std::filesystem::is_directory(path_, error)) reject("cannot create", detail::reason(ENOTDIR));
    const std::filesystem::path probe = path_ / (".dmp-write-check-" + std::to_string(::getpid()));
    try {
      detail::OutputFile file(probe);
      file.write("may be removed\n");
      file.close();
    } catch (const WriteError& failure) {
      std::filesystem::remove(probe, error);
      reject("cannot write into", failure.what());
    }
    if (!std::filesystem::remove(probe, error)) reject("cannot remove files from", error.message());
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] friend std::filesystem::path operator/(const OutputFolder& folder, std::string_view name) { return folder.path_ / name; }

 private:
  [[noreturn]] void reject(const char* what, const std::string& why) const {
    throw ParameterError(std::string("io::OutputFolder: ") + what + " " + detail::quoted(path_) + ": " + why);
  }

  std::filesystem::path path_;
};

}  // namespace dmp::io
