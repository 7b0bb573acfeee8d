// SPDX-License-Identifier: BSD-3-Clause
#include "OutputFiles.h"

#include "ExitCodes.h"
#include "Interrupt.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

namespace silhouette::program
{
namespace fs = std::filesystem;
namespace
{

[[noreturn]] void failWriting(const fs::path& file, const std::string& why)
{
  throw ProgramError(FileFailed, "cannot write " + file.string() + ": " + why);
}

fs::path folderOf(const fs::path& file)
{
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/** The place behind a symbolic link, so that renaming replaces the file and not the link. */
fs::path behindLinks(const fs::path& target)
{
  std::error_code ignored;
  const fs::path real = fs::is_symlink(target, ignored) ? fs::canonical(target, ignored) : fs::path();
  return real.empty() ? target : real;
}

mode_t creationMask()
{
  const mode_t mask = umask(0);
  umask(mask);
  return mask;
}

/** In lower case: writers add what they look for in vain. */
std::string extensionOf(const fs::path& file)
{
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

/** "mesh.ply" to ".mesh-XXXXXX.ply": writers that look at the extension find the right one. */
std::vector<char> namePattern(const fs::path& target, const std::string& extension)
{
  const std::string name = "." + target.stem().string() + "-XXXXXX" + extension;
  const std::string text = (folderOf(target) / name).string();
  std::vector<char> pattern(text.begin(), text.end());
  pattern.push_back('\0');
  return pattern;
}

/** Whether a folder holds what a synthesised capture consists of, and nothing else. */
bool holdsOnlyACapture(const fs::path& folder)
{
  constexpr std::array<const char*, 4> parts = { "masks", "images", "projections.txt", "truth.ply" };
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
  {
    bool known = false;
    for (const char* part : parts)
    {
      known = known || entry.path().filename() == part;
    }
    if (!known)
    {
      return false;
    }
  }
  return true;
}

} // namespace

void checkWritable(const fs::path& file)
{
  std::error_code ignored;
  if (!file.has_filename())
  {
    failWriting(file, "this names no file");
  }
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))
  {
    failWriting(file, fs::is_directory(file, ignored) ? "it is a folder" : "it is not a regular file");
  }
  const fs::path folder = folderOf(behindLinks(file));
  if (!fs::is_directory(folder, ignored))
  {
    failWriting(file, "there is no folder " + folder.string());
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0)
  {
    failWriting(file, "the folder " + folder.string() + ": " + std::strerror(errno));
  }
}

StagedFile::StagedFile(const fs::path& target)
  : Target(behindLinks(target))
{
  checkWritable(target);
  const std::string extension = extensionOf(this->Target);
  std::vector<char> pattern = namePattern(this->Target, extension);
  const int file = mkstemps(pattern.data(), static_cast<int>(extension.size()));
  if (file < 0)
  {
    failWriting(target, std::strerror(errno));
  }
  fchmod(file, 0666 & ~creationMask());
  close(file);
  this->Temporary = pattern.data();
}

StagedFile::~StagedFile()
{
  std::error_code ignored;
  if (!this->Temporary.empty())
  {
    fs::remove(this->Temporary, ignored);
  }
}

void StagedFile::commit()
{
  checkInterrupt();
  this->place();
}

void StagedFile::place()
{
  std::error_code error;
  fs::rename(this->Temporary, this->Target, error);
  if (error)
  {
    failWriting(this->Target, error.message());
  }
  this->Temporary.clear();
}

StagedFile& StagedFiles::add(const fs::path& target)
{
  return this->Files.emplace_back(target);
}

void StagedFiles::commit()
{
  checkInterrupt();
  for (StagedFile& file : this->Files)
  {
    file.place();
  }
}

StagedFolder::StagedFolder(const fs::path& target, bool replace)
  : Target(target)
{
  // The place itself, whatever leads to it: what is on its way lies beside it, not in it.
  std::error_code ignored;
  this->Target = fs::weakly_canonical(fs::absolute(target, ignored), ignored);
  this->Target = this->Target.has_filename() ? this->Target : this->Target.parent_path();
  if (fs::exists(this->Target, ignored) && !fs::is_directory(this->Target, ignored))
  {
    failWriting(this->Target, "there is a file of this name");
  }
  if (fs::is_directory(this->Target, ignored) && !fs::is_empty(this->Target, ignored))
  {
    if (!replace)
    {
      failWriting(this->Target, "the folder is not empty; --force replaces a capture");
    }
    if (!holdsOnlyACapture(this->Target))
    {
      failWriting(this->Target, "the folder holds something else than a capture, which --force does not remove");
    }
  }
  fs::create_directories(folderOf(this->Target), ignored);
  std::vector<char> pattern = namePattern(this->Target, "");
  if (!mkdtemp(pattern.data()))
  {
    failWriting(this->Target, std::strerror(errno));
  }
  chmod(pattern.data(), 0777 & ~creationMask());
  this->Temporary = pattern.data();
}

StagedFolder::~StagedFolder()
{
  std::error_code ignored;
  if (!this->Temporary.empty())
  {
    fs::remove_all(this->Temporary, ignored);
  }
}

void StagedFolder::commit()
{
  checkInterrupt();
  std::error_code error;
  fs::path old;
  if (fs::is_directory(this->Target) && !fs::is_empty(this->Target))
  {
    old = this->Temporary.string() + "-old";
    fs::rename(this->Target, old, error);
  }
  if (!error)
  {
    fs::rename(this->Temporary, this->Target, error);
  }
  if (error)
  {
    std::error_code ignored;
    if (!old.empty() && !fs::exists(this->Target, ignored))
    {
      fs::rename(old, this->Target, ignored);
    }
    failWriting(this->Target, error.message());
  }
  this->Temporary = old; // what is removed at the end
}

void writeText(const StagedFile& file, const std::string& text)
{
  std::ofstream stream(file.path(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream)
  {
    failWriting(file.target(), "not all of it was written; is the disk full?");
  }
}

void writeText(const fs::path& file, const std::string& text)
{
  StagedFile staged(file);
  writeText(staged, text);
  staged.commit();
}

} // namespace silhouette::program
