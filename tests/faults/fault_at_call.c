// Copyright 2026 The periporo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A library for LD_PRELOAD that lets the system fail at a chosen call on the files of one folder.
//
// It counts the calls that change something below FAULT_FOLDER: opening to create, writing, cutting, flushing,
// renaming, deleting. At call number FAULT_AT it does what FAULT_KIND says:
//     kill   ends the process before the call
//     half   ends the process in the middle of a write, before any other call
//     fail   lets this call and all later ones that need room or a file handle fail with the number FAULT_ERROR
// FAULT_COUNT names a file that gets the number of calls when the process ends.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static long calls;

static bool is_kind(const char* kind)
{
    const char* given = getenv("FAULT_KIND");
    return given && strcmp(given, kind) == 0;
}

static bool is_inside(const char* path)
{
    const char* folder = getenv("FAULT_FOLDER");
    return folder && path && strncmp(path, folder, strlen(folder)) == 0;
}

static bool is_file_inside(int descriptor)
{
    char link[64], path[4096];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0)
        return false;
    path[length] = '\0';
    return is_inside(path);
}

/// Counts a call. Ends the process when it is to be killed here. Returns true when the call is to fail.
static bool fault_here(bool needs_room)
{
    const char* text = getenv("FAULT_AT");
    const long at = text ? atol(text) : 0;
    const long call = __sync_add_and_fetch(&calls, 1);
    if (at == 0 || call < at)
        return false;
    if (is_kind("fail"))
        return needs_room;
    if (call == at)
        kill(getpid(), SIGKILL);
    return false;
}

static bool failing(bool inside, bool needs_room)
{
    if (!inside || !fault_here(needs_room))
        return false;
    const char* number = getenv("FAULT_ERROR");
    errno = number ? atoi(number) : EIO;
    return true;
}

/// Is the next call the one that is to be left in the middle?
static bool half_here(void)
{
    const char* at = getenv("FAULT_AT");
    return is_kind("half") && at && calls + 1 == atol(at);
}

__attribute__((destructor)) static void report(void)
{
    const char* name = getenv("FAULT_COUNT");
    FILE* (*open_file)(const char*, const char*) = (FILE * (*)(const char*, const char*)) dlsym(RTLD_NEXT, "fopen");
    FILE* file = name ? open_file(name, "w") : NULL;
    if (!file)
        return;
    fprintf(file, "%ld\n", calls);
    fclose(file);
}

#define NEXT(result, name, ...)                                                                                        \
    static result (*next)(__VA_ARGS__);                                                                                \
    if (!next)                                                                                                         \
    next = (result(*)(__VA_ARGS__))dlsym(RTLD_NEXT, #name)

#define OPEN(name)                                                                                                     \
    int name(const char* path, int flags, ...)                                                                         \
    {                                                                                                                  \
        NEXT(int, name, const char*, int, ...);                                                                        \
        mode_t mode = 0;                                                                                               \
        if (flags & O_CREAT) {                                                                                         \
            va_list list;                                                                                              \
            va_start(list, flags);                                                                                     \
            mode = va_arg(list, mode_t);                                                                               \
            va_end(list);                                                                                              \
            if (failing(is_inside(path), true))                                                                        \
                return -1;                                                                                             \
        }                                                                                                              \
        return next(path, flags, mode);                                                                                \
    }
OPEN(open)
OPEN(open64)

#define FOPEN(name)                                                                                                    \
    FILE* name(const char* path, const char* mode)                                                                     \
    {                                                                                                                  \
        NEXT(FILE*, name, const char*, const char*);                                                                   \
        return failing(mode[0] != 'r' && is_inside(path), true) ? NULL : next(path, mode);                             \
    }
FOPEN(fopen)
FOPEN(fopen64)

ssize_t write(int descriptor, const void* bytes, size_t size)
{
    NEXT(ssize_t, write, int, const void*, size_t);
    const bool inside = is_file_inside(descriptor);
    if (inside && half_here())
        next(descriptor, bytes, size / 2);
    return failing(inside, true) ? -1 : next(descriptor, bytes, size);
}

#define PWRITE(name, offset_type)                                                                                      \
    ssize_t name(int descriptor, const void* bytes, size_t size, offset_type place)                                    \
    {                                                                                                                  \
        NEXT(ssize_t, name, int, const void*, size_t, offset_type);                                                    \
        const bool inside = is_file_inside(descriptor);                                                                \
        if (inside && half_here())                                                                                     \
            next(descriptor, bytes, size / 2, place);                                                                  \
        return failing(inside, true) ? -1 : next(descriptor, bytes, size, place);                                      \
    }
PWRITE(pwrite, off_t)
PWRITE(pwrite64, off64_t)

#define ON_DESCRIPTOR(name, parameters, arguments)                                                                     \
    int name parameters                                                                                                \
    {                                                                                                                  \
        static int(*next) parameters;                                                                                  \
        if (!next)                                                                                                     \
            next = (int(*) parameters)dlsym(RTLD_NEXT, #name);                                                         \
        return failing(is_file_inside(descriptor), false) ? -1 : next arguments;                                       \
    }
ON_DESCRIPTOR(fsync, (int descriptor), (descriptor))
ON_DESCRIPTOR(fdatasync, (int descriptor), (descriptor))
ON_DESCRIPTOR(ftruncate, (int descriptor, off_t length), (descriptor, length))
ON_DESCRIPTOR(ftruncate64, (int descriptor, off64_t length), (descriptor, length))

#define ON_PATH(name, needs_room, parameters, arguments)                                                               \
    int name parameters                                                                                                \
    {                                                                                                                  \
        static int(*next) parameters;                                                                                  \
        if (!next)                                                                                                     \
            next = (int(*) parameters)dlsym(RTLD_NEXT, #name);                                                         \
        return failing(is_inside(path), needs_room) ? -1 : next arguments;                                             \
    }
ON_PATH(mkdir, true, (const char* path, mode_t mode), (path, mode))
ON_PATH(rename, false, (const char* path, const char* name), (path, name))
ON_PATH(unlink, false, (const char* path), (path))
ON_PATH(remove, false, (const char* path), (path))
ON_PATH(rmdir, false, (const char* path), (path))
