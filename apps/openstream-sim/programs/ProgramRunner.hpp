#pragma once

#include "programs/ProgramSpec.hpp"
#include <acs/core/Now.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace ACS::OpenStreamSim
{

enum class EProgramEvent : std::uint8_t
{
    Started,  ///< From its beginning; not when it goes on after a stop.
    Finished, ///< At its end, well.
    Failed,   ///< At its end, or given up in the middle: by a reset, or because another one was selected.
};

struct ProgramEvent
{
    EProgramEvent kind = EProgramEvent::Started;
    int number = 0;

    bool operator==(const ProgramEvent&) const = default;
};

using ProgramEvents = std::vector<ProgramEvent>;

/// The base task: one program is selected; it runs for its time, may be stopped and go on, and ends. Then it stands at
/// its beginning again. Times are simulated, since the controller's start. The events of a call are appended to `out`.
class ProgramRunner
{
    enum class EPhase : std::uint8_t
    {
        AtBeginning,
        Running,
        Halted, ///< In the middle.
    };

    std::map<int, ProgramSpec> _programs;
    ProgramSpec _otherPrograms;
    EPhase _phase = EPhase::AtBeginning;
    int _selected = 0;
    ProgramSpec _spec;
    Core::Duration _elapsed{}; ///< Of the program's own time, until _resumedAt.
    Core::Duration _resumedAt{};

public:
    ProgramRunner(std::map<int, ProgramSpec> programs, ProgramSpec otherPrograms);

    /// At its beginning; must not run.
    void Select(int number, ProgramEvents& out);

    /// Starts or goes on; one must be selected and must not run.
    void Start(Core::Duration now, ProgramEvents& out);

    /// Nothing happens where none runs.
    void Stop(Core::Duration now);

    /// Back to the beginning.
    void Reset(ProgramEvents& out);

    void Advance(Core::Duration now, ProgramEvents& out);

    [[nodiscard]] bool IsRunning() const noexcept;
    [[nodiscard]] bool IsAtBeginning() const noexcept;

    /// 0 where none is selected.
    [[nodiscard]] int GetSelected() const noexcept;
    /// Of the selected program.
    [[nodiscard]] const ProgramSpec& GetSpec() const noexcept;

    /// When the running program ends; nullopt: none runs.
    [[nodiscard]] std::optional<Core::Duration> GetEndOrNull() const noexcept;

    /// How long the selected program has run, stops left out.
    [[nodiscard]] Core::Duration GetElapsed(Core::Duration now) const noexcept;
    [[nodiscard]] Core::Duration GetDuration() const noexcept;

private:
    void GiveUp(ProgramEvents& out);
};

} // namespace ACS::OpenStreamSim
