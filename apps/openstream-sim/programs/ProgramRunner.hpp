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
    Started,  ///< At its beginning; not when it continues after a stop.
    Finished, ///< At its end, successfully.
    Failed,   ///< At its end, or abandoned before: by a reset or the selection of another program.
};

struct ProgramEvent
{
    EProgramEvent kind = EProgramEvent::Started;
    int number = 0;

    bool operator==(const ProgramEvent&) const = default;
};

using ProgramEvents = std::vector<ProgramEvent>;

/// The base task: one program is selected, runs for its duration, may be stopped and continued, and ends. Then it is at its
/// beginning again. Times are simulated, since the controller's start. The events of a call are appended to `out`.
class ProgramRunner
{
    enum class EPhase : std::uint8_t
    {
        AtBeginning,
        Running,
        Halted, ///< Before its end.
    };

    std::map<int, ProgramSpec> _programs;
    ProgramSpec _otherPrograms;
    EPhase _phase = EPhase::AtBeginning;
    int _selected = 0;
    ProgramSpec _spec;
    Core::Duration _elapsed{}; ///< Time that the program has run until _resumedAt.
    Core::Duration _resumedAt{};

public:
    ProgramRunner(std::map<int, ProgramSpec> programs, ProgramSpec otherPrograms);

    /// Selects a program at its beginning; none may run.
    void Select(int number, ProgramEvents& out);

    /// Starts or continues the selected program; one must be selected and must not run.
    void Start(Core::Duration now, ProgramEvents& out);

    /// No effect if no program runs.
    void Stop(Core::Duration now);

    /// Back to the beginning.
    void Reset(ProgramEvents& out);

    void Advance(Core::Duration now, ProgramEvents& out);

    [[nodiscard]] bool IsRunning() const noexcept;
    [[nodiscard]] bool IsAtBeginning() const noexcept;

    /// 0 if none is selected.
    [[nodiscard]] int GetSelected() const noexcept;
    /// Of the selected program.
    [[nodiscard]] const ProgramSpec& GetSpec() const noexcept;

    /// End of the running program; nullopt if none runs.
    [[nodiscard]] std::optional<Core::Duration> GetEndOrNull() const noexcept;

    /// Time that the selected program has run, without stops.
    [[nodiscard]] Core::Duration GetElapsed(Core::Duration now) const noexcept;
    [[nodiscard]] Core::Duration GetDuration() const noexcept;

private:
    void Abandon(ProgramEvents& out);
};

} // namespace ACS::OpenStreamSim
