// SPDX-License-Identifier: BSD-3-Clause
/**
 * Output that is whole or not there: written beside its place under another name, then renamed.
 */
#pragma once

#include <filesystem>
#include <list>
#include <string>

namespace silhouette::program
{

/**
 * Throws ProgramError (FileFailed) that names `file` where it could not be written in the end: no such folder,
 * no right to write in it, a folder or something else than a file in its place. To be asked before the work.
 */
void checkWritable(const std::filesystem::path& file);

/** A file on its way. Until commit() nothing is seen of it; without commit() nothing is left of it. */
class StagedFile
{
public:
  /** Makes an empty file beside `target`, of the same extension in lower case. Throws ProgramError (FileFailed). */
  explicit StagedFile(const std::filesystem::path& target);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  /** Where to write. */
  const std::filesystem::path& path() const { return this->Temporary; }
  const std::filesystem::path& target() const { return this->Target; }

  /** Puts the file in its place, over what was there. Throws ProgramError (FileFailed), or Interrupted. */
  void commit();

private:
  friend class StagedFiles;
  void place();

  std::filesystem::path Target;
  std::filesystem::path Temporary;
};

/** Files that come together: none is seen before all are there. */
class StagedFiles
{
public:
  /** One more; stays as long as this. Throws as StagedFile does. */
  StagedFile& add(const std::filesystem::path& target);

  /** Puts all files in their places, without asking for interrupts between. Throws as StagedFile::commit(). */
  void commit();

private:
  std::list<StagedFile> Files;
};

/** A folder on its way, in the same manner. */
class StagedFolder
{
public:
  /**
   * Makes an empty folder beside `target`. Throws ProgramError (FileFailed) where that fails or where `target` is
   * there and not empty; with `replace` only where it holds something else than a capture.
   */
  StagedFolder(const std::filesystem::path& target, bool replace);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return this->Temporary; }

  /** Puts the folder in its place, instead of what was there. Throws ProgramError (FileFailed), or Interrupted. */
  void commit();

private:
  std::filesystem::path Target;
  std::filesystem::path Temporary;
};

/** Write `text` to a file on its way. Throws ProgramError (FileFailed). */
void writeText(const StagedFile& file, const std::string& text);

/** Write `text` to a file, all or nothing. Throws ProgramError (FileFailed), or Interrupted. */
void writeText(const std::filesystem::path& file, const std::string& text);

} // namespace silhouette::program
