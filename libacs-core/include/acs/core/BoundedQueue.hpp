#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

namespace ACS::Core
{

/// A FIFO queue with a fixed capacity. Not shared between threads.
template <typename TElement>
class BoundedQueue
{
public:
    using value_type = TElement;
    using iterator = typename std::deque<TElement>::iterator;
    using const_iterator = typename std::deque<TElement>::const_iterator;

private:
    std::size_t _capacity;
    std::deque<TElement> _elements;

public:
    explicit BoundedQueue(std::size_t capacity)
        : _capacity(capacity)
    {
    }

    /// Returns false and leaves the element unchanged if the queue is full.
    [[nodiscard]] bool TryPush(TElement&& element)
    {
        if (IsFull())
        {
            return false;
        }
        _elements.push_back(std::move(element));
        return true;
    }

    [[nodiscard]] bool TryPush(const TElement& element)
    {
        if (IsFull())
        {
            return false;
        }
        _elements.push_back(element);
        return true;
    }

    /// The oldest element; null if the queue is empty. Valid until the queue is changed.
    [[nodiscard]] TElement* GetFrontOrNull() noexcept
    {
        return _elements.empty() ? nullptr : &_elements.front();
    }

    [[nodiscard]] const TElement* GetFrontOrNull() const noexcept
    {
        return _elements.empty() ? nullptr : &_elements.front();
    }

    /// Removes and returns the oldest element; nullopt if the queue is empty.
    std::optional<TElement> PopFrontOrNull()
    {
        if (_elements.empty())
        {
            return std::nullopt;
        }
        std::optional<TElement> front(std::move(_elements.front()));
        _elements.pop_front();
        return front;
    }

    /// Removes all elements that match the predicate; returns their number.
    template <typename TPredicate>
    std::size_t EraseIf(TPredicate predicate)
    {
        return std::erase_if(_elements, std::move(predicate));
    }

    void Clear() noexcept
    {
        _elements.clear();
    }

    [[nodiscard]] bool IsEmpty() const noexcept
    {
        return _elements.empty();
    }

    [[nodiscard]] bool IsFull() const noexcept
    {
        return _elements.size() >= _capacity;
    }

    [[nodiscard]] std::size_t GetSize() const noexcept
    {
        return _elements.size();
    }

    [[nodiscard]] std::size_t GetCapacity() const noexcept
    {
        return _capacity;
    }

    /// From the oldest to the newest.
    [[nodiscard]] iterator begin() noexcept
    {
        return _elements.begin();
    }

    [[nodiscard]] iterator end() noexcept
    {
        return _elements.end();
    }

    [[nodiscard]] const_iterator begin() const noexcept
    {
        return _elements.begin();
    }

    [[nodiscard]] const_iterator end() const noexcept
    {
        return _elements.end();
    }
};

} // namespace ACS::Core
