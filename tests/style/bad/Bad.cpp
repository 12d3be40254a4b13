// Each line marked EXPECT breaks the rule that it names, and clang-tidy must say so.
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>
#include <stdlib.h> // EXPECT modernize-deprecated-headers
#include <string>
#include <vector>

namespace bad_names // EXPECT readability-identifier-naming
{

enum class Colour // EXPECT readability-identifier-naming
{
    Red,
    green, // EXPECT readability-identifier-naming
};

class robot_list // EXPECT readability-identifier-naming
{
public:
    int GetSize() const { return size; } // EXPECT modernize-use-nodiscard
    void setSize(int new_size) { size = new_size; } // EXPECT readability-identifier-naming

protected:
    int room = 0; // EXPECT readability-identifier-naming

private:
    int size = 0; // EXPECT readability-identifier-naming
    int m_age = 0; // EXPECT readability-identifier-naming
    const int bound_ = 3; // EXPECT readability-identifier-naming
    static constexpr int kLimit = 4; // EXPECT readability-identifier-naming
};

struct Report
{
    int PageCount = 0; // EXPECT readability-identifier-naming
};

class Adapter // EXPECT readability-identifier-naming
{
public:
    virtual ~Adapter() = default;
    virtual void StartJobAsync(int jobID = 1) = 0; // EXPECT google-default-arguments
};

class Vehicle : public Adapter
{
public:
    virtual void StartJobAsync(int jobID); // EXPECT modernize-use-override
};

class Payload // EXPECT cppcoreguidelines-virtual-class-destructor
{
public:
    virtual void Clear();
};

using id_list = std::vector<int>; // EXPECT readability-identifier-naming
typedef std::vector<int> NumberList; // EXPECT modernize-use-using

template <typename Value> // EXPECT readability-identifier-naming
int CountValues(const std::vector<Value>& values)
{
    return static_cast<int>(values.size());
}

const int retryCount = 3; // EXPECT readability-identifier-naming
int globalCount = 0; // EXPECT cppcoreguidelines-avoid-non-const-global-variables
const std::string GREETING = std::string(100, 'x'); // EXPECT cert-err58-cpp

#define TWICE(x) ((x) * 2) // EXPECT cppcoreguidelines-macro-usage
#define THREE 3 // EXPECT cppcoreguidelines-macro-usage

int count_all(int Start) // EXPECT readability-identifier-naming
{
    int unset; // EXPECT cppcoreguidelines-init-variables
    if (Start > 1) return 1; // EXPECT readability-braces-around-statements
    unset = 2;
    int *Raw = new int(3), other = 4; // EXPECT readability-isolate-declaration
    unset += *Raw + other;
    delete Raw;
    if (Raw) // EXPECT readability-implicit-bool-conversion
    {
        return unset;
    }
    else // EXPECT readability-else-after-return
    {
        return 0;
    }
}

const int* GetNothingOrNull()
{
    return 0; // EXPECT modernize-use-nullptr
}

int CountDown(int depth) // EXPECT misc-no-recursion
{
    return depth < 2 ? depth : CountDown(depth - 1);
}

void ThrowNumber()
{
    throw 1; // EXPECT hicpp-exception-baseclass
}

void CatchByValue()
{
    try
    {
        ThrowNumber();
    }
    catch (std::runtime_error error) // EXPECT misc-throw-by-value-catch-by-reference
    {
    }
}

int AddUp(const std::vector<int>& values)
{
    int total = 0;
    for (int e : values) // EXPECT readability-identifier-length
    {
        total += e;
    }
    for (int i = 0; i < 3; ++i)
    {
        total += values.at(0);
    }
    for (const std::string text : std::vector<std::string>{"one"}) // EXPECT performance-for-range-copy
    {
        total += static_cast<int>(text.size());
    }
    total += 2.5; // EXPECT cppcoreguidelines-narrowing-conversions
    return total;
}

int Leap(int number)
{
    if (number > 1)
    {
        goto end; // EXPECT cppcoreguidelines-avoid-goto
    }
    number = std::atoi("1"); // EXPECT cert-err34-c
end:
    return number;
}

void UseMemory()
{
    int numbers[3] = {1, 2, 3}; // EXPECT modernize-avoid-c-arrays
    void* memory = std::malloc(sizeof(numbers)); // EXPECT cppcoreguidelines-no-malloc
    std::free(memory);
}

std::string CopyTwice(std::string text)
{
    std::string moved = std::move(text);
    return moved + text; // EXPECT bugprone-use-after-move
}

std::size_t MeasureCopy(std::string unchanged) // EXPECT performance-unnecessary-value-param
{
    return unchanged.size();
}

int Tangle(const std::vector<int>& values, int first, int second) // EXPECT readability-function-cognitive-complexity
{
    int total = 0;
    for (const int value : values)
    {
        if (value > first)
        {
            for (const int inner : values)
            {
                if (inner > second)
                {
                    if (inner > first && value > second)
                    {
                        if (inner != value || first != second)
                        {
                            total += inner > 0 ? (value > 0 ? 1 : 2) : 3;
                        }
                    }
                    else if (inner == value)
                    {
                        --total;
                    }
                }
            }
        }
    }
    return total;
}

class Number
{
public:
    Number(int value) : _value(value) {} // EXPECT google-explicit-constructor

private:
    int _value;
};

class Copied // EXPECT cppcoreguidelines-special-member-functions
{
public:
    Copied(const Copied& other);
};

class Holder
{
    int _count;

public:
    Holder() // EXPECT cppcoreguidelines-pro-type-member-init
    {
    }

    void Take(int& target) const
    {
        target = _count;
    }
};

using namespace std; // EXPECT google-build-using-namespace

} // namespace bad_names
