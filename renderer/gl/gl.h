/* SPDX-License-Identifier: MIT */
/* The OpenGL functions that fieldcast calls, loaded by name through EGL, and what drivers report.
 * No context is made here (egl.h). */
#ifndef RENDERER_GL_H
#define RENDERER_GL_H

#include <GL/glcorearb.h>
#include <stdbool.h>

#include "protocol/error.h"

/* X(PFN suffix, name without gl): the one list of what is called, from OpenGL 3.3 on; */
#define GL_FUNCTIONS(X)                                                                            \
    X(ACTIVETEXTURE, ActiveTexture)                                                                \
    X(ATTACHSHADER, AttachShader)                                                                  \
    X(BINDBUFFER, BindBuffer)                                                                      \
    X(BINDBUFFERBASE, BindBufferBase)                                                              \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                            \
    X(BINDTEXTURE, BindTexture)                                                                    \
    X(BINDVERTEXARRAY, BindVertexArray)                                                            \
    X(BLENDFUNC, BlendFunc)                                                                        \
    X(BUFFERDATA, BufferData)                                                                      \
    X(BUFFERSUBDATA, BufferSubData)                                                                \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                              \
    X(CLEAR, Clear)                                                                                \
    X(CLIENTWAITSYNC, ClientWaitSync)                                                              \
    X(COMPILESHADER, CompileShader)                                                                \
    X(COPYTEXSUBIMAGE2D, CopyTexSubImage2D)                                                        \
    X(CREATEPROGRAM, CreateProgram)                                                                \
    X(CREATESHADER, CreateShader)                                                                  \
    X(DELETEBUFFERS, DeleteBuffers)                                                                \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                      \
    X(DELETEPROGRAM, DeleteProgram)                                                                \
    X(DELETEQUERIES, DeleteQueries)                                                                \
    X(DELETESHADER, DeleteShader)                                                                  \
    X(DELETESYNC, DeleteSync)                                                                      \
    X(DELETETEXTURES, DeleteTextures)                                                              \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                      \
    X(DISABLE, Disable)                                                                            \
    X(DRAWARRAYS, DrawArrays)                                                                      \
    X(DRAWBUFFERS, DrawBuffers)                                                                    \
    X(ENABLE, Enable)                                                                              \
    X(FENCESYNC, FenceSync)                                                                        \
    X(FINISH, Finish)                                                                              \
    X(FLUSH, Flush)                                                                                \
    X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                                                  \
    X(GENBUFFERS, GenBuffers)                                                                      \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                            \
    X(GENQUERIES, GenQueries)                                                                      \
    X(GENTEXTURES, GenTextures)                                                                    \
    X(GENVERTEXARRAYS, GenVertexArrays)                                                            \
    X(GETBUFFERSUBDATA, GetBufferSubData)                                                          \
    X(GETERROR, GetError)                                                                          \
    X(GETINTEGERV, GetIntegerv)                                                                    \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                        \
    X(GETPROGRAMIV, GetProgramiv)                                                                  \
    X(GETQUERYOBJECTUI64V, GetQueryObjectui64v)                                                    \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                          \
    X(GETSHADERIV, GetShaderiv)                                                                    \
    X(GETSTRING, GetString)                                                                        \
    X(GETUNIFORMBLOCKINDEX, GetUniformBlockIndex)                                                  \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                      \
    X(LINKPROGRAM, LinkProgram)                                                                    \
    X(MAPBUFFERRANGE, MapBufferRange)                                                              \
    X(PIXELSTOREI, PixelStorei)                                                                    \
    X(QUERYCOUNTER, QueryCounter)                                                                  \
    X(READBUFFER, ReadBuffer)                                                                      \
    X(READPIXELS, ReadPixels)                                                                      \
    X(SHADERSOURCE, ShaderSource)                                                                  \
    X(TEXBUFFER, TexBuffer)                                                                        \
    X(TEXIMAGE2D, TexImage2D)                                                                      \
    X(TEXPARAMETERI, TexParameteri)                                                                \
    X(TEXSUBIMAGE2D, TexSubImage2D)                                                                \
    X(UNIFORM1I, Uniform1i)                                                                        \
    X(UNIFORM2I, Uniform2i)                                                                        \
    X(UNIFORMBLOCKBINDING, UniformBlockBinding)                                                    \
    X(UNMAPBUFFER, UnmapBuffer)                                                                    \
    X(USEPROGRAM, UseProgram)                                                                      \
    X(VIEWPORT, Viewport)
/* and from 4.3 on, where there are compute shaders. */
#define GL_COMPUTE_FUNCTIONS(X)                                                                    \
    X(BINDIMAGETEXTURE, BindImageTexture)                                                          \
    X(DEBUGMESSAGECALLBACK, DebugMessageCallback)                                                  \
    X(DISPATCHCOMPUTE, DispatchCompute)                                                            \
    X(DISPATCHCOMPUTEINDIRECT, DispatchComputeIndirect)                                            \
    X(MEMORYBARRIER, MemoryBarrier)                                                                \
    X(TEXSTORAGE3D, TexStorage3D)

struct gl {
#define X(upper, name) PFNGL##upper##PROC name;
    GL_FUNCTIONS(X)
    GL_COMPUTE_FUNCTIONS(X) /* NULL without has_compute */
#undef X
    bool has_compute; /* of OpenGL 4.3 */
    /* NULL where the context cannot lose itself. */
    PFNGLGETGRAPHICSRESETSTATUSPROC GetGraphicsResetStatus;
};

/* Needs a current context. */
bool gl_load(struct gl *out_gl, struct error *err);

/* Where drivers' messages go; outlives the context. */
struct gl_sink {
    void (*log)(void *data, const char *line); /* may be NULL */
    void *data;
};
/* Sends what the driver reports as an error, or as of high severity, to `sink`; nothing below
 * OpenGL 4.3. */
void gl_debug(const struct gl *gl, const struct gl_sink *sink);

/* "GL_OUT_OF_MEMORY" */
const char *gl_error_name(GLenum error);
/* True when no error is pending; else `err` names `what` and the first error. */
bool gl_check(const struct gl *gl, const char *what, struct error *err);

#endif
