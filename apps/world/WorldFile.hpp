#pragma once

#include "world/IWorld.hpp"
#include "world/MemoryWorld.hpp"
#include "world/WorldJournal.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Sim
{

/// The floor that the simulators of several processes share: a world file, which is only read, and beside it FILE.journal, to
/// which each process appends what its robots do. Each call knows what all processes did before it. One thread at a time.
class WorldFile final : public IWorld
{
    std::unique_ptr<MemoryWorld> _world;
    WorldJournal _journal;
    std::optional<Core::Error> _failure; ///< Of the last ReadNews.

    WorldFile(std::unique_ptr<MemoryWorld> world, WorldJournal journal);

public:
    /// The error names the file, and what is wrong where in it.
    [[nodiscard]] static Core::Result<std::unique_ptr<WorldFile>> Open(const std::string& path);

    [[nodiscard]] Core::Result<void> Act(const WorldEvent& event) override;
    // Without the news where the journal cannot be read; Act and GetFailureOrNull say so.
    [[nodiscard]] std::optional<std::string> GetCarrierOrNull(std::string_view place) override;
    [[nodiscard]] std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) override;
    [[nodiscard]] EMemory GetMemory(std::string_view place) override;
    [[nodiscard]] bool IsCovered(std::string_view set) override;
    [[nodiscard]] std::vector<WorldEvent> TakeEvents() override;
    [[nodiscard]] std::optional<Core::Error> GetFailureOrNull() const override;

private:
    [[nodiscard]] Core::Result<void> ReadNews();
};

} // namespace ACS::Sim
