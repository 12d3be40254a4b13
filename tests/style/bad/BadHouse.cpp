// House rules that clang-tidy 14 has no check for; scripts/house-rules.clang-query must report each EXPECT-QUERY line
// and no other.
#include <atomic>
#include <optional>
#include <memory>

namespace ACS
{

struct Robot
{
    bool online = false; // EXPECT-QUERY
    bool bDriving = false;
    std::optional<bool> paused; // EXPECT-QUERY
    std::optional<bool> bLoaded;
};

class Vehicle
{
    bool _stopping = false; // EXPECT-QUERY
    bool _bFired = false;
    std::atomic<bool> _running = false; // EXPECT-QUERY

public:
    static constexpr bool IS_SIMULATED = true;

    bool Stop(bool force) // EXPECT-QUERY
    {
        bool done = force && _stopping; // EXPECT-QUERY
        const bool bDone = done || _bFired || _running;
        return bDone;
    }

    bool Issue() const // EXPECT-QUERY
    {
        return _bFired;
    }

    bool IsStopped() const
    {
        return _bFired;
    }

    bool ShouldStop() const
    {
        return _bFired;
    }

    bool StartObject(int first, int second, int third); // EXPECT-QUERY

    const Robot* FindRobot() const // EXPECT-QUERY
    {
        return nullptr;
    }

    std::unique_ptr<Robot> MakeRobot() const
    {
        return nullptr;
    }

    std::optional<int> GetSpeed() const // EXPECT-QUERY
    {
        return std::nullopt;
    }

    std::optional<int> GetSpeedOrNull() const
    {
        return std::nullopt;
    }
};

} // namespace ACS

enum Plain // EXPECT-QUERY
{
    One,
};

enum class ELevel
{
    Heavy,
    ERROR, // EXPECT-QUERY
};
