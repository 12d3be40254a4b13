#pragma once

#include "world/IWorld.hpp"
#include "world/MemoryWorld.hpp"
#include "world/WorldJournal.hpp"

#include <tl/expected.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Sim
{

/// The floor that simulators in several processes share: a world file, which is only read, and FILE.journal, to which each
/// process appends the events of its robots. Each call first reads the new events of all processes. Called by one thread at a
/// time.
class WorldFile final : public IWorld
{
    std::unique_ptr<MemoryWorld> _world;
    WorldJournal _journal;
    std::optional<Core::Error> _failure; ///< Error of the last ReadNewEvents.

    WorldFile(std::unique_ptr<MemoryWorld> world, WorldJournal journal);

public:
    /// An error names the file and the path in it.
    [[nodiscard]] static Core::Result<std::unique_ptr<WorldFile>> Open(const std::string& path);

    [[nodiscard]] Core::Result<void> Act(const WorldEvent& event) override;
    // If the journal cannot be read, these functions return the state without the new events, and Act and GetFailureOrNull return
    // the error.
    [[nodiscard]] std::optional<std::string> GetCarrierOrNull(std::string_view place) override;
    [[nodiscard]] std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) override;
    [[nodiscard]] EMemory GetMemory(std::string_view place) override;
    [[nodiscard]] bool IsCovered(std::string_view set) override;
    [[nodiscard]] std::vector<WorldEvent> TakeEvents() override;
    [[nodiscard]] std::optional<Core::Error> GetFailureOrNull() const override;

private:
    [[nodiscard]] Core::Result<void> ReadNewEvents();
};

/// Opens the file of the option --world; null if the path is empty. The error is one sentence that names the option.
[[nodiscard]] tl::expected<std::unique_ptr<IWorld>, std::string> OpenWorldOption(const std::string& path);

} // namespace ACS::Sim
