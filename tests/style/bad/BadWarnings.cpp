// The compilers' part: each line marked EXPECT-WARNING must be reported with that flag; EXPECT-GNU by g++ alone.
#include <cstdint>
#include <cstdio>

namespace ACS
{

enum class EColour
{
    Red,
    Green,
};

struct Point
{
    int x = 0;
    int y;
};

class Base // EXPECT-WARNING -Wnon-virtual-dtor
{
public:
    virtual void Draw(int count);
};

class Derived : public Base // EXPECT-GNU -Wnon-virtual-dtor
{
public:
    void Draw(double count); // EXPECT-CLANG -Woverloaded-virtual
    void Clear() {}; // EXPECT-WARNING -Wextra-semi
};

int Choose(EColour colour, int number, unsigned size)
{
    int total = (int)2.5; // EXPECT-WARNING -Wold-style-cast
    {
        int total = number; // EXPECT-WARNING -Wshadow
        number += total;
    }
    std::uint8_t small = 0;
    small = number; // EXPECT-WARNING conversion
    size = number; // EXPECT-WARNING -Wsign-conversion
    const Point point{.x = 1}; // EXPECT-GNU -Wmissing-field-initializers
    switch (colour) // EXPECT-WARNING -Wswitch
    {
        case EColour::Red:
            return point.y;
        default:
            break;
    }
    switch (number) // EXPECT-GNU -Wswitch-default
    {
        case 1:
            return small;
    }
    std::printf(reinterpret_cast<const char*>(&size)); // EXPECT-WARNING -Wformat
    if (number > 1)
    {
        total = 1;
    }
    else if (number > 1) // EXPECT-GNU -Wduplicated-cond
    {
        total = 2;
    }
    total += static_cast<int>(number); // EXPECT-GNU -Wuseless-cast
    return number > 3 && number > 3 ? 1 : total; // EXPECT-GNU -Wlogical-op
}

} // namespace ACS
