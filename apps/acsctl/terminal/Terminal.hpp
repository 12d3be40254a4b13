#pragma once

#include "view/TextTable.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// Standard input and output.
class Terminal final
{
    const bool _bColored;
    const std::optional<std::size_t> _columnsOrNull;
    bool _bRedrawn = false;
    bool _bFailed = false;

public:
    /// Colours are shown on a terminal only. The number of columns replaces that of the terminal.
    Terminal(bool bColorWanted, std::optional<std::size_t> columnsOrNull);

    /// The width of the terminal; unlimited for a file or a pipe. At least 20 columns.
    [[nodiscard]] Screen GetScreen() const;
    /// Whether the operator sees the output and can answer.
    [[nodiscard]] static bool CanAsk();
    [[nodiscard]] static bool IsTerminal();
    /// Whether output was lost: the disk is full.
    [[nodiscard]] bool IsFailed() const noexcept;

    void Write(std::string_view text);
    /// On a terminal in the place of the text before, cut at its last line; else below it, after an empty line.
    void Redraw(const std::string& text);
    /// Writes the question on standard error and reads the answer; only "y" and "yes" are true.
    [[nodiscard]] static bool IsConfirmed(const std::string& question);
};

} // namespace ACS::Acsctl
