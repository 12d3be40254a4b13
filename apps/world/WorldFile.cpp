#include "world/WorldFile.hpp"

#include "common/config/TextFile.hpp"
#include "world/EWorldError.hpp"
#include "world/WorldEventCodec.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Sim
{
namespace
{

tl::unexpected<Core::Error> RefuseFile(const std::string& path, Core::Error error)
{
    error.path = error.path.empty() ? path : fmt::format("{}: {}", path, error.path);
    return tl::make_unexpected(std::move(error));
}

} // namespace

WorldFile::WorldFile(std::unique_ptr<MemoryWorld> world, WorldJournal journal)
    : _world(std::move(world)),
      _journal(std::move(journal))
{
}

Core::Result<std::unique_ptr<WorldFile>> WorldFile::Open(const std::string& path)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        return Core::Fail(
            std::make_error_code(std::errc::io_error),
            path,
            "a world file that can be read",
            text.error());
    }
    const Core::Result<WorldStart> start = DecodeWorldStart(*text);
    if (!start.has_value())
    {
        return RefuseFile(path, start.error());
    }
    Core::Result<std::unique_ptr<MemoryWorld>> world = MemoryWorld::Create(*start);
    if (!world.has_value())
    {
        return RefuseFile(path, world.error());
    }
    Core::Result<WorldJournal> journal = WorldJournal::Open(path + ".journal");
    if (!journal.has_value())
    {
        return tl::make_unexpected(journal.error());
    }
    std::unique_ptr<WorldFile> file(new WorldFile(std::move(*world), std::move(*journal)));
    const Core::Result<void> read = file->ReadNewEvents();
    if (!read.has_value())
    {
        return tl::make_unexpected(read.error());
    }
    static_cast<void>(file->_world->TakeEvents());
    return file;
}

Core::Result<void> WorldFile::Act(const WorldEvent& event)
{
    const Core::Result<WorldJournal::Lock> lock = _journal.Acquire();
    if (!lock.has_value())
    {
        return tl::make_unexpected(lock.error());
    }
    Core::Result<void> done = ReadNewEvents();
    if (!done.has_value())
    {
        return done;
    }
    const Core::Result<WorldEvent> checked = _world->Check(event);
    if (!checked.has_value())
    {
        return tl::make_unexpected(checked.error());
    }
    if (_world->IsRepeated(*checked))
    {
        return {};
    }
    done = _journal.Append(EncodeWorldEvent(*checked));
    return done.has_value() ? ReadNewEvents() : done;
}

std::optional<std::string> WorldFile::GetCarrierOrNull(std::string_view place)
{
    static_cast<void>(ReadNewEvents());
    return _world->GetCarrierOrNull(place);
}

std::optional<std::string> WorldFile::GetPlaceOrNull(std::string_view carrierID)
{
    static_cast<void>(ReadNewEvents());
    return _world->GetPlaceOrNull(carrierID);
}

EMemory WorldFile::GetMemory(std::string_view place)
{
    static_cast<void>(ReadNewEvents());
    return _world->GetMemory(place);
}

bool WorldFile::IsCovered(std::string_view set)
{
    static_cast<void>(ReadNewEvents());
    return _world->IsCovered(set);
}

std::vector<WorldEvent> WorldFile::TakeEvents()
{
    static_cast<void>(ReadNewEvents());
    return _world->TakeEvents();
}

std::optional<Core::Error> WorldFile::GetFailureOrNull() const
{
    return _failure;
}

Core::Result<void> WorldFile::ReadNewEvents()
{
    Core::Result<void> done = _journal.ReadNewLines([this](std::string_view line) -> Core::Result<void> {
        const Core::Result<WorldEvent> event = DecodeWorldEvent(line);
        return event.has_value() ? _world->Act(*event) : tl::make_unexpected(event.error());
    });
    _failure = done.has_value() ? std::nullopt : std::optional(done.error());
    return done;
}

tl::expected<std::unique_ptr<IWorld>, std::string> OpenWorldOption(const std::string& path)
{
    if (path.empty())
    {
        return nullptr;
    }
    Core::Result<std::unique_ptr<WorldFile>> opened = WorldFile::Open(path);
    if (!opened.has_value())
    {
        return tl::make_unexpected("--world: " + Core::Describe(opened.error()));
    }
    return std::move(*opened);
}

} // namespace ACS::Sim
