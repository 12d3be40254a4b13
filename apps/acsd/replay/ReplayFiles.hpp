#pragma once

#include "replay/CoreRecord.hpp"
#include <acs/core/Result.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Reads the records of a trace, which is one file or a folder with the files of --trace, in their order.
class ReplayFiles final
{
public:
    /// The snapshot of a store with the largest outbox is shorter.
    static constexpr std::size_t LONGEST_LINE = 256U * 1024U * 1024U;

private:
    std::deque<std::string> _files; ///< Not opened yet.
    std::ifstream _file;
    std::string _name; ///< Of the open file.
    std::uint64_t _line = 0;
    std::string _fault;
    std::size_t _longestLine = LONGEST_LINE;
    std::string _firstFault;
    bool _bTrace = false;            ///< A line of a trace was read.
    std::optional<CoreRecord> _next; ///< Read, and not taken: the first of the next run.

public:
    /// Fails with a sentence if there is no such file, or if it is not a regular one.
    [[nodiscard]] static Core::Result<ReplayFiles> Open(
        const std::string& path,
        std::size_t longestLine = LONGEST_LINE);

    /// The first record of the next run, after the rest of the current one; nullopt: there is none.
    [[nodiscard]] std::optional<CoreRecord> FindRunOrNull();

    /// The next record of the run; nullopt at its end and at the first line that is missing or damaged.
    [[nodiscard]] std::optional<CoreRecord> ReadNextOrNull();

    /// Why the run has ended before its last record; empty: it has not.
    [[nodiscard]] const std::string& GetFault() const noexcept;

    /// Why the files are not a trace, after all of them were read; empty: they are one.
    [[nodiscard]] std::string DescribeForeign() const;

private:
    [[nodiscard]] std::optional<CoreRecord> ReadOrNull();
    void SetFault(std::string fault);
    [[nodiscard]] bool TryReadLine(std::string& line);
    [[nodiscard]] bool TryReadRest(std::string& line);
};

} // namespace ACS::Acsd
